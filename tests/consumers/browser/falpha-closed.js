// F_alpha in closed form, against values in high precision.
import { flat, largestDifference, rows, snippet, withBothSines } from './jobs.js';

const alpha = 0.2;
const values = [
    [20, 15, 1.8901438839298736], [20, 45, 0.2722569611850245], [20, 75, 0.023254638025755423],
    [60, 15, 0.07600163461048545], [60, 45, 0.7872043926777261], [60, 75, 0.33354570223087154],
];

export function makeJobs() {
    const rad = Math.PI / 180;
    return withBothSines({
        name: 'relative to six values',
        source: snippet('falpha-closed'),
        result: 'return vec4(irido_falpha_closed(a.x, a.y, a.z), 0.0, 0.0, 1.0);',
        points: flat(values.map(([i, d]) => [alpha, i * rad, d * rad])),
        check: (bound) => (found) =>
            largestDifference(rows(found, 1).map(([f], i) => [f / values[i][2]]), values.map(() => [1]), bound),
    }, 2e-6, 2e-3);
}
