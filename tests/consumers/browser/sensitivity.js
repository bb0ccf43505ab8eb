// Transforms of the observer, against the same transforms at paths between the samples.
import assert from 'node:assert/strict';
import { csvValues, irido, randomNumbers } from '../support/irido.js';
import { axis, flat, glsl, interpolatedIn, largestDifference, makeTable, rows, snippet, statedError } from './jobs.js';

const sigmas = [0, 40, 80, 120];
const longest = 8000;

export function makeJobs(folder) {
    const random = randomNumbers(3);
    const paths = Array.from({ length: 60 }, () => random(0, longest)).sort((a, b) => a - b).concat(longest);
    const text = irido('lut', 'sensitivity', '--opd', paths.join(), '--sigma', sigmas.join(), '--dtype', 'f64');
    const all = csvValues(text, 2);
    /** Six numbers at a path and at a level, between two of which they are mixed. */
    const exact = (path, level) => {
        const of = (l) => all.slice(6 * (l * paths.length + path), 6 * (l * paths.length + path) + 6);
        const low = Math.floor(level), high = Math.ceil(level);
        return of(low).map((value, c) => value + (of(high)[c] - value) * (level - low));
    };
    const points = paths.map((_, i) => [i, [0, 0.25, 1, 1.5, 2, 2.75, 3][i % 7]]);
    const expected = points.map(([i, level]) => exact(i, level));
    const jobs = [];
    for (const [name, args] of Object.entries({
        'with its carrier': ['--opd', `0:${longest}/1024`],
        'without its carrier': ['--opd', `0:${longest}/256`, '--carrier'],
        'real parts': ['--opd', `0:${longest}/1024`, '--real'],
    }))
        for (const type of ['f16', 'f32']) {
            const file = `sensitivity-${jobs.length}.ktx2`;
            const metadata = makeTable(folder, file, 'sensitivity', ...args, '--sigma', sigmas.join(), '--dtype', type);
            const opdAxis = axis(metadata.axes[1]);
            const carrier = `vec3(${(metadata.request.carrier_nm ?? [0, 0, 0]).map(glsl).join(', ')})`;
            const samples = interpolatedIn(`${folder}/${file}`,
                points.map(([i, level]) => ({ place: [paths[i]], level })));
            const isReal = metadata.channels.length === 3;
            // the phase of the carrier is rounded, and float multiplies
            const bound = statedError(metadata) + (metadata.request.carrier_nm ? 2e-5 : 1e-6);
            const job = {
                tables: { table: `/tables/${file}` },
                source: snippet('sensitivity'),
                points: flat(points.map(([i, level]) => [paths[i], level])),
                mayWarn: true,
            };
            const check = (first) => (values, { table }) => {
                assert.equal(table.volume, false);
                assert.equal(table.levels, sigmas.length);
                if (!metadata.request.carrier_nm)
                    largestDifference(rows(values, 3), samples.map((row) => row.slice(first, first + 3)), 1e-5);
                return largestDifference(rows(values, 3), expected.map((row) => row.slice(first, first + 3)), bound);
            };
            const call = (part) => `vec3 re, im;
    irido_sensitivity(table, ${opdAxis}, ${carrier}, a.x, a.y, re, im);
    return vec4(${part}, 1.0);`;
            if (isReal) {
                const result = `return vec4(irido_sensitivity_real(table, ${opdAxis}, a.x, a.y), 1.0);`;
                jobs.push({ ...job, name: `${name}, ${type}`, result, check: check(0) });
                continue;
            }
            jobs.push({ ...job, name: `${name}, real, ${type}`, result: call('re'), check: check(0) });
            jobs.push({ ...job, name: `${name}, imaginary, ${type}`, result: call('im'), check: check(3) });
        }
    return jobs;
}
