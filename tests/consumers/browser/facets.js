// A rough stack by its colours over theta_d and the facets' distribution, against irido's BRDF.
import { writeFileSync } from 'node:fs';
import { csv, irido, randomNumbers } from '../support/irido.js';
import { axis, flat, largestDifference, makeTable, rows, snippet } from './jobs.js';

const stack = '1 | 1.5@300 | 2+3i', alpha = 0.3;

const direction = (theta, phi) => {
    const [t, p] = [theta * Math.PI / 180, phi * Math.PI / 180];
    return [Math.sin(t) * Math.cos(p), Math.sin(t) * Math.sin(p), Math.cos(t)];
};

export function facetJobs(folder) {
    const random = randomNumbers(12);
    const pairs = Array.from({ length: 60 }, () => [random(0, 80), random(0, 360), random(0, 80), random(0, 360)]);
    const file = `${folder}/facets.csv`;
    writeFileSync(file, ['light_theta_deg,light_phi_deg,view_theta_deg,view_phi_deg', ...pairs.map(String)].join('\n'));
    const expected = csv(irido('brdf', stack, '--alpha', alpha, '--directions', file, '--color'))
        .map(({ r, g, b }) => [r, g, b].map(Number));
    const { axes } = makeTable(folder, 'facets.ktx2', 'color', stack, '--cos', '0:1/512');
    return [{
        name: 'facets', tables: { table: '/tables/facets.ktx2' }, source: snippet('color') + snippet('facets'),
        result: `vec3 light = a.xyz, view = vec3(a.w, b.xy);
    return vec4(3.14159265359 * irido_facets(${alpha}, light, view)
        * irido_color_of_angle(table, ${axis(axes[0])}, irido_cos_theta_d(light, view)), 1.0);`,
        points: flat(pairs.map(([lt, lp, vt, vp]) => [...direction(lt, lp), ...direction(vt, vp)])), mayWarn: true,
        check: (values) => largestDifference(rows(values, 3), expected, 2e-4),
    }];
}
