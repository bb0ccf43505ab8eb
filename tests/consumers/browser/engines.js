// The iridescence of three.js, its own shader chunk, against irido's version of it in double precision.
import { writeFileSync } from 'node:fs';
import { ShaderChunk } from 'three';
import { csv, irido, randomNumbers } from '../support/irido.js';
import { flat, largestDifference, rows, withBothSines } from './jobs.js';

const source = `#define USE_IRIDESCENCE
${ShaderChunk.common}
${ShaderChunk.iridescence_fragment}`;

/** Reflectance of n + ik in air at normal incidence. */
function f0({ n, k }) {
    return ((n - 1) ** 2 + k ** 2) / ((n + 1) ** 2 + k ** 2);
}

export function makeJobs(folder) {
    const random = randomNumbers(5);
    const films = Array.from({ length: 600 }, (_, i) => {
        const base = () => (i % 2 === 1 ? { n: 0.2 + 3 * random(), k: 0.5 + 4 * random() } : { n: 1.1 + 1.5 * random(), k: 0 });
        const gray = base();
        return {
            n: 1 + 1.5 * random(), d: 1000 * random(), angle: 89 * random(),
            bases: i % 3 === 0 ? [base(), base(), base()] : [gray, gray, gray],
        };
    });
    const file = `${folder}/films.csv`;
    writeFileSync(file, ['id,film_n,film_d_nm,angle_deg,base_n_r,base_n_g,base_n_b,base_k_r,base_k_g,base_k_b',
        ...films.map(({ n, d, angle, bases }, i) =>
            [i, n, d, angle, ...bases.map((base) => base.n), ...bases.map((base) => base.k)].join())].join('\n') + '\n');
    const expected = csv(irido('compare', '--films', file, '--rows', '--engine', 'three'))
        .map(({ r, g, b }) => [Number(r), Number(g), Number(b)]);
    return withBothSines({
        name: 'iridescence of three.js',
        source,
        result: 'return vec4(clamp(evalIridescence(1.0, a.x, a.z, a.y, b.xyz), 0.0, 1.0), 1.0);',
        points: flat(films.map(({ n, d, angle, bases }) =>
            [n, d, Math.cos(angle * Math.PI / 180), 0, ...bases.map(f0)])),
        check: (bound) => (values) => largestDifference(rows(values, 3), expected, bound),
    }, 2e-5, 2e-4);
}
