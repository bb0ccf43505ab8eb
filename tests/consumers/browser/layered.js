// Rough layered surfaces in a shader, against irido's own BRDF at 100 pairs of directions.
import { fileURLToPath } from 'node:url';
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { csv, irido, randomNumbers } from '../support/irido.js';
import { deltaE2000, labFromSrgb } from '../support/color.js';
import { axis, flat, glsl, makeTable, rows, snippet } from './jobs.js';

const surfaces = { 'green-on-pale': 1, 'blue-over-red': 2 };

export const wgslNumber = glsl;

export function surfaceFile(name) {
    return fileURLToPath(new URL(`../../../schemas/examples/surfaces/${name}.json`, import.meta.url));
}

const direction = (theta, phi) => {
    const [t, p] = [theta * Math.PI / 180, phi * Math.PI / 180];
    return [Math.sin(t) * Math.cos(p), Math.sin(t) * Math.sin(p), Math.cos(t)];
};

/** 100 pairs of directions: points of their six numbers, and pi times irido's BRDF there. */
export function layeredPairs(folder, surface) {
    const random = randomNumbers(9);
    const pairs = Array.from({ length: 100 }, () => [random(0, 80), random(0, 360), random(0, 80), random(0, 360)]);
    const file = `${folder}/pairs.csv`;
    writeFileSync(file, ['light_theta_deg,light_phi_deg,view_theta_deg,view_phi_deg', ...pairs.map(String)].join('\n'));
    return {
        points: flat(pairs.map(([lt, lp, vt, vp]) => [...direction(lt, lp), ...direction(vt, vp)])),
        expected: csv(irido('brdf', surface, '--directions', file, '--color'))
            .map(({ r, g, b }) => [Number(r), Number(g), Number(b)]),
    };
}

/** What came back, RGBA of each pair, within a fifth of the error that the table states. */
export function checkColors(values, expected, metadata, most = 1) {
    const differences = rows(values, 3).map((rgb, i) => {
        const seen = rgb.map((value) => value * Math.PI);
        const bright = Math.max(1, ...expected[i], ...seen);
        const lab = (color) => labFromSrgb(color.map((value) => value / bright));
        return deltaE2000(lab(seen), lab(expected[i]));
    });
    const largest = Math.max(...differences), stated = metadata.error.value;
    assert.ok(stated < most, `stated are ${stated}`);
    assert.ok(largest <= 1.2 * stated + 0.02, `Delta E 2000 is ${largest}, stated are ${stated}`);
    return `largest Delta E 2000 ${largest.toPrecision(2)}, stated ${stated.toPrecision(2)}`;
}

export function makeJobs(folder) {
    return Object.entries(surfaces).map(([name, layers]) => {
        const surface = surfaceFile(name);
        const metadata = makeTable(folder, `${name}.ktx2`, 'layered', surface);
        const { alpha, groups, n_outside_per_n_inside: ratio } = metadata.request;
        const { points, expected } = layeredPairs(folder, surface);
        const axes = metadata.axes.map(axis);
        return {
            name,
            tables: { table: `/tables/${name}.ktx2` },
            source: `#define IRIDO_LAYERS ${layers}\n${snippet('layered')}`,
            result: `float alpha[IRIDO_LAYERS];\n${alpha.map((a, l) => `alpha[${l}] = ${glsl(a)};`).join(' ')}
return vec4(irido_layered(table, ${axes.join(', ')}, ${groups}, alpha, ${glsl(ratio)}, 1.0, a.xyz, vec3(a.w, b.xy)), 1.0);`,
            points,
            check: (values) => checkColors(values, expected, metadata),
        };
    });
}
