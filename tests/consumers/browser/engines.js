// The iridescence of three.js, its own shader chunk, against irido's version of it in double precision.
import { writeFileSync } from 'node:fs';
import { ShaderChunk } from 'three';
import { csv, irido, randomNumbers } from '../support/irido.js';
import { flat, largestDifference, rows, withBothSines } from './jobs.js';

const source = `#define USE_IRIDESCENCE
${ShaderChunk.common}
${ShaderChunk.iridescence_fragment}`;

export function makeJobs(folder) {
    const random = randomNumbers(5);
    const films = Array.from({ length: 400 }, (_, i) => {
        const conducts = i % 2 === 1;
        return {
            n: 1 + 1.5 * random(), d: 1000 * random(), angle: 89 * random(),
            baseN: conducts ? 0.2 + 3 * random() : 1.1 + 1.5 * random(), baseK: conducts ? 0.5 + 4 * random() : 0,
        };
    });
    const file = `${folder}/films.csv`;
    writeFileSync(file, ['id,film_n,film_d_nm,angle_deg,base_n,base_k',
        ...films.map(({ n, d, angle, baseN, baseK }, i) => [i, n, d, angle, baseN, baseK].join())].join('\n') + '\n');
    const expected = csv(irido('compare', '--films', file, '--rows', '--engine', 'three'))
        .map(({ r, g, b }) => [Number(r), Number(g), Number(b)]);
    return withBothSines({
        name: 'three.js, films over gray bases',
        source,
        result: `return vec4(clamp(evalIridescence(1.0, a.x, a.z, a.y, vec3(a.w)), 0.0, 1.0), 1.0);`,
        points: flat(films.map(({ n, d, angle, baseN, baseK }) => [n, d, Math.cos(angle * Math.PI / 180),
            ((baseN - 1) ** 2 + baseK ** 2) / ((baseN + 1) ** 2 + baseK ** 2)])),
        check: (bound) => (values) => largestDifference(rows(values, 3), expected, bound),
    }, 5e-5, 2e-4);
}
