// Mirrors in closed form, against irido's spectra.
import { csv, irido } from '../support/irido.js';
import { flat, glsl, largestDifference, rows, snippet, withBothSines } from './jobs.js';

const mirrors = [[1, 120, 1.5, 100], [1.46, 94.2, 2.4, 58.5], [1.6, 160, 1.3, 200]];
// With good sines and with those of the device, each multiplied by the periods; after a thousand of them
// nothing is left of the latter.
const bounds = { 5: [5e-6, 5e-3], 20: [5e-5, 5e-2], 1000: [3e-3, null] };
const angles = [0, 20, 40, 60], wavelengths = Array.from({ length: 60 }, (_, i) => 380 + 7 * i);

export function makeJobs() {
    return mirrors.flatMap(([n1, d1, n2, d2]) => Object.entries(bounds).flatMap(([periods, both]) => {
        const stack = `${n1} | (${n1}@${d1} | ${n2}@${d2})^${periods} | ${n1}`;
        const text = irido('spectrum', stack, '-w', wavelengths.join(), '-a', angles.join());
        const lines = csv(text).filter((row) => n1 * Math.sin(row.angle_deg * Math.PI / 180) < n2);
        return withBothSines({
            name: stack,
            source: snippet('bragg'),
            result: `return vec4(irido_bragg(${[n1, d1, n2, d2, periods].map(glsl).join(', ')}, a.x, a.y), 0.0, 0.0, 1.0);`,
            points: flat(lines.map((row) => [Math.cos(row.angle_deg * Math.PI / 180), Number(row.wavelength_nm)])),
            check: (bound) => (values) =>
                largestDifference(rows(values, 1), lines.map((row) => [Number(row.R)]), bound),
        }, ...both);
    }));
}
