// The series of one film's fringes, against irido's own X, Y, Z.
import { csv, iridoEach, randomNumbers } from '../support/irido.js';
import { axis, flat, glsl, largestDifference, makeTable, rows, snippet } from './jobs.js';

const orders = 24;
const films = {
    'a soap film on glass': [1, 1.33, 1.5, 0],
    'oxide on a metal': [1, 1.42, 1.87, 1.182],
    'titanium dioxide on silver': [1, 2.4, 0.13, 3.4],
    'a strong film in glass': [1.5, 2.4, 1.2, 0],
    'silicon dioxide on silicon': [1, 1.46, 4.08, 0.03],
};

export async function makeJobs(folder) {
    const random = randomNumbers(4), jobs = [];
    const tables = [
        ['f32, carrier divided out', ['--opd', '0:30000/1024', '--carrier', '--dtype', 'f32'], 1e-4],
        ['f16, carrier divided out', ['--opd', '0:30000/1024', '--carrier', '--dtype', 'f16'], 5e-4],
        ['f32, with its carrier', ['--opd', '0:30000/4096', '--dtype', 'f32'], 5e-4],
    ];
    const points = Array.from({ length: 40 }, (_, i) => [random(0, i % 2 ? 300 : 2000), Math.cos(random(0, 1.5))]);
    const made = tables.map(([name, args, bound], i) => {
        const file = `fourier-${i}.ktx2`;
        return { name, file, bound, metadata: makeTable(folder, file, 'sensitivity', ...args) };
    });
    for (const [film, [n1, n2, n3, k3]] of Object.entries(films)) {
        const base = k3 ? `${n3}+${k3}i` : n3;
        const answers = await iridoEach(points.map(([thickness, cosine]) => ['color', `${n1} | ${n2}@${thickness} | ${base}`,
            '-a', Math.acos(cosine) * 180 / Math.PI]));
        const expected = answers.map((text) => {
            const [{ X, Y, Z }] = csv(text);
            return [Number(X), Number(Y), Number(Z)];
        });
        for (const { name, file, bound, metadata } of made) {
            const carrier = (metadata.request.carrier_nm ?? [0, 0, 0]).map(glsl).join(', ');
            jobs.push({
                name: `${film}, ${name}`,
                tables: { table: `/tables/${file}` },
                source: snippet('fourier'),
                result: `return vec4(irido_film(table, ${axis(metadata.axes[1])}, vec3(${carrier}), vec4(0.0), ${glsl(n1)}, ${glsl(n2)},
        vec2(${glsl(n3)}, ${glsl(k3)}), a.x, 0.0, a.y, ${orders}), 1.0);`,
                points: flat(points),
                mayWarn: true,
                check: (values) => largestDifference(rows(values, 3), expected, bound),
            });
        }
    }
    return jobs;
}
