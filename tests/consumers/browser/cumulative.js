// Cumulative integrals, against the same integrals at wavelengths between the samples.
import { csvValues, irido, randomNumbers } from '../support/irido.js';
import { axis, flat, largestDifference, makeTable, rows, snippet, spacing } from './jobs.js';

export function makeJobs(folder) {
    const random = randomNumbers(2);
    const wavelengths = Array.from({ length: 100 }, () => random(340, 850)).sort((a, b) => a - b);
    const exact = csvValues(irido('lut', 'cumulative', '-w', wavelengths.join(), '--dtype', 'f64'), 1);
    const expected = wavelengths.map((_, i) => exact.slice(3 * i, 3 * i + 3));
    return ['f16', 'f32'].flatMap((type) => {
        const file = `cumulative-${type}.ktx2`;
        const metadata = makeTable(folder, file, 'cumulative', '--dtype', type);
        const wavelengthAxis = axis(metadata.axes[0]);
        const bound = metadata.error.value + 4 * spacing('f32', 1);
        const common = {
            tables: { table: `/tables/${file}` },
            source: snippet('cumulative'),
            mayWarn: true,  // three.js knows no XYZ and says so; it takes the numbers as they are
        };
        const pairs = wavelengths.slice(50).map((_, i) => [i, 2 * i + 1]);
        return [
            {
                ...common,
                name: `sums, ${type}`,
                result: `return vec4(irido_cumulative(table, ${wavelengthAxis}, a.x), 1.0);`,
                points: flat(wavelengths.map((nm) => [nm])),
                check: (values) => largestDifference(rows(values, 3), expected, bound),
            },
            {
                ...common,
                name: `boxes, ${type}`,
                result: `return vec4(irido_box(table, ${wavelengthAxis}, a.x, a.y), 1.0);`,
                points: flat(pairs.map(([i, j]) => [wavelengths[i], wavelengths[j]])),
                check: (values) => largestDifference(rows(values, 3),
                    pairs.map(([i, j]) => expected[j].map((value, c) => value - expected[i][c])), 2 * bound),
            },
        ];
    });
}
