// Tables of rough layers, against their own samples, interpolated here.
import assert from 'node:assert/strict';
import { kinds, randomNumbers, readLevel } from '../support/irido.js';
import { axis, flat, interpolatedIn, largestDifference, makeTable, rows, snippet } from './jobs.js';

const mirror = '1 | (1@250 | 1.5@250)^10 | 1', film = '1 | 1.33@400 | 1.5+3i';
const angles = ['--theta-i', '0:88:4'], wavelengths = ['--wavelengths', '400:700:10'];

/** Kind, name, arguments, a sample of the same layout, and the call: a has the place along the axes. */
const tables = [
    ['falpha', 'one alpha', ['--alpha', '0.2', ...angles, '--theta-d', '0:88:2'], '1-1x4x8',
        ([, i, d]) => `vec3(irido_falpha(table, ${i}, ${d}, a.y, a.z), 0.0, 0.0)`],
    ['falpha', 'three alphas', ['--alpha', '0.1,0.2,0.3', ...angles, '--theta-d', '0:88:2'], '1-3x4x8',
        ([alpha, i, d]) => `vec3(irido_falpha_volume(table, ${alpha}, ${i}, ${d}, a.x, a.y, a.z), 0.0, 0.0)`],
    ['transmissivity', 'one alpha', [mirror, '--alpha', '0.1', ...angles, ...wavelengths], '1-1x4x8',
        ([, i, w]) => `vec3(irido_transmissivity(table, ${i}, ${w}, a.y, a.z), 0.0, 0.0)`],
    ['transmissivity', 'three alphas', [mirror, '--alpha', '0.1,0.2,0.3', ...angles, ...wavelengths], '1-3x4x8',
        ([alpha, i, w]) => `vec3(irido_transmissivity_volume(table, ${alpha}, ${i}, ${w}, a.x, a.y, a.z), 0.0, 0.0)`],
    ['albedo', 'a film', [film, '--alpha', '0:1/8', '--cos-theta', '0:1/8'], '3-4x8',
        ([cosine, alpha]) => `irido_albedo(table, ${cosine}, ${alpha}, a.x, a.y)`],
];

export function makeJobs(folder) {
    const random = randomNumbers(5);
    const makeJob = (kind, name, file, call) => {
        const { metadata, values: stored } = readLevel(`${folder}/${file}.ktx2`);
        const places = Array.from({ length: 100 },
            () => ({ place: metadata.axes.map(({ first, last }) => random(first, last)) }));
        const largest = stored.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
        const relative = (row) => row.map((value) => value / largest);
        const expected = interpolatedIn(`${folder}/${file}.ktx2`, places).map(relative);
        return {
            name: `${kind}, ${name}`,
            tables: { table: `/tables/${file}.ktx2` },
            source: snippet(kind),
            result: `return vec4(${call(metadata.axes.map(axis))}, 1.0);`,
            points: flat(places.map(({ place }) => place)),
            check(values, { table }) {
                assert.equal(table.volume, metadata.axes.length === 3 && metadata.axes[0].count > 1);
                return largestDifference(rows(values, metadata.channels.length).map(relative), expected, 1e-5);
            },
        };
    };
    return tables.flatMap(([kind, name, args, sample, call], t) => ['f16', 'f32'].flatMap((type) => {
        // the folder has the samples of the textures
        const jobs = [makeJob(kind, `like ${name}, ${type}`, `${type}-${sample}`, call)];
        if (!kinds.has(kind)) return [...jobs, { kind, name: `${kind}, ${name}, ${type}` }];
        const file = `kind-${t}-${type}`;
        makeTable(folder, `${file}.ktx2`, kind, ...args, '--dtype', type);
        return [...jobs, { kind, ...makeJob(kind, `${name}, ${type}`, file, call) }];
    }));
}
