// Scratches: tables with their carrier divided out, wide lights in f32 and narrow ones in f16, the footprint's
// table, and the spectrum at a few nodes, against exact tables.
import { writeFileSync } from 'node:fs';
import { csvValues, irido, randomNumbers } from '../support/irido.js';
import { flat, glsl, goodSines, largestDifference, makeTable, rows, snippet } from './jobs.js';

/** T at u and depth, in double, odd in u. */
function exactPowers(points) {
    const values = new Map();
    for (const [u, depth] of points) {
        const text = irido('lut', 'scratch', '--u', String(Math.abs(u)), '--depth', String(depth), '--derivative');
        const [x, y, z, dx, dy, dz] = csvValues(text, 2);
        const sign = Math.sign(u);
        values.set(`${u},${depth}`, { power: [sign * x, sign * y, sign * z], slope: [dx, dy, dz] });
    }
    return (u, depth) => values.get(`${u},${depth}`);
}

/** Scratches through the origin in a perfect mirror under point lights near their band: what the shader takes, X, Y, Z. */
function pointPairs(folder, random) {
    const direction = (theta, phi) => [Math.sin(theta) * Math.cos(phi), Math.sin(theta) * Math.sin(phi), Math.cos(theta)];
    const degrees = 180 / Math.PI;
    return Array.from({ length: 12 }, (_, i) => {
        const width = random(0.8, 3), depth = random(0.05, 0.6), across = random(-0.7, 0.7), view = random(0.1, 0.6);
        const along = -Math.sin(view) + (i % 2 ? random(-0.0008, 0.0008) : 0);
        const theta = Math.asin(Math.hypot(along, across)), phi = Math.atan2(across, along);
        const surface = `${folder}/one-${i}.json`;
        writeFileSync(surface, JSON.stringify({ scratches: [{ width_um: width, depth_um: depth, angle_deg: 0, point_um: [0, 0] }] }));
        const text = irido('brdf', surface, '--light-theta', theta * degrees, `--light-phi=${phi * degrees}`, '--view-theta',
            view * degrees, '--view-phi', 0, '--color', '--quiet');
        const [light, eye] = [direction(theta, phi), direction(view, 0)];
        return {
            point: [width, light[0] + eye[0], light[1], depth * (light[2] + eye[2])],
            xyz: text.trim().split('\n')[1].split(',').slice(4, 7).map((value) => value / Math.PI),
        };
    });
}

/** The axis of depths as the snippets take it, with the scale of its places. */
const deepAxis = ({ first, last, count }, { depth_scale_um: scale = 0 }) =>
    `vec4(${[first, last, count, scale].map(glsl).join(', ')})`;

export function makeJobs(folder) {
    const random = randomNumbers(9);
    const lights = Array.from({ length: 24 }, (_, i) => {
        const width = random(0.8, 6), depth = Math.fround(random(0.05, 3)), q0 = random(-0.9, 0.7);
        const q1 = q0 + (i % 2 ? random(0.2, 0.8) : random(0.002, 0.03));
        return { u0: Math.fround(width * q0), u1: Math.fround(width * q1), depth };
    });
    const exact = exactPowers(lights.flatMap(({ u0, u1, depth }) => [[u0, depth], [u1, depth]]));
    const difference = ({ u0, u1, depth }) =>
        exact(u1, depth).power.map((value, c) => value - exact(u0, depth).power[c]);
    const carried = (file, ...args) => makeTable(folder, file, 'scratch', '--carrier', ...args);
    const call = (name, { axes, request }) => `return vec4(${name}(table, vec2(${glsl(request.u_scale_um)},
        ${glsl(axes[0].count)}), ${deepAxis(axes[1], request)}, vec3(${request.carrier_um.map(glsl).join(', ')}),
        1.0, b.x, a.x, a.y), 1.0);`;
    const points = (some) => flat(some.map(({ u0, u1, depth }) => [u0, u1, 0, 0, depth]));
    const job = (name, file, result, some, expected, bound) => ({
        name, tables: { table: `/tables/${file}` }, source: goodSines + snippet(name.split(',')[0]), result,
        points: points(some), mayWarn: true,
        check: (values) => largestDifference(rows(values, expected[0].length), expected, bound),
    });
    const wide = lights.filter((_, i) => i % 2), narrow = lights.filter((_, i) => i % 2 === 0);
    const wideTable = carried('scratch.ktx2'), narrowTable = carried('narrow.ktx2', '--per-place', '--dtype', 'f16');
    irido('lut', 'scratch-nodes', '--count', '49', '--quiet', '-o', `${folder}/nodes.ktx2`);
    makeTable(folder, 'footprint.ktx2', 'scratch-footprint');
    const short = lights.map((light) => ({ ...light, depth: Math.min(light.depth, 0.6) }))
        .map(({ u0, u1, depth }) => ({ u0: Math.max(-3, u0), u1: Math.min(3, u1), depth: Math.fround(depth) }));
    const exactShort = exactPowers(short.flatMap(({ u0, u1, depth }) => [[u0, depth], [u1, depth]]));
    const pairs = pointPairs(folder, random);
    const sides = [[9.330127, 82.978759, 0.6763527859]];
    return [
        job('scratch, wide lights', 'scratch.ktx2', call('irido_scratch_wide', wideTable), wide,
            wide.map(difference), 2e-3),
        job('scratch, narrow lights', 'narrow.ktx2', call('irido_scratch_narrow', narrowTable), narrow,
            narrow.map(difference), 1e-3),
        job('scratch-nodes, 49 nodes', 'nodes.ktx2',
            'return vec4(irido_scratch_nodes(table, 49.0, a.x, a.y, 2.0 * b.x), 1.0);', short,
            short.map(({ u0, u1, depth }) =>
                exactShort(u1, depth).power.map((value, c) => value - exactShort(u0, depth).power[c])), 2e-5),
        job('scratch-nodes, slopes', 'nodes.ktx2',
            'return vec4(irido_scratch_nodes_slope(table, 49.0, a.x, 2.0 * b.x), 1.0);', short,
            short.map(({ u0, depth }) => exactShort(u0, depth).slope), 5e-5),
        {
            name: 'scratch-nodes, points', tables: { table: '/tables/nodes.ktx2' }, source: goodSines + snippet('scratch-nodes'),
            result: 'return vec4(irido_scratch_nodes_point(table, 49.0, a.x, vec2(a.y, a.z), a.w, 60.0), 1.0);',
            points: flat(pairs.map(({ point }) => point)), mayWarn: true,
            check: (values) => largestDifference(rows(values, 3).map((row, i) => row.map((x, c) => x / Math.max(...pairs[i].xyz))),
                pairs.map(({ xyz }) => xyz.map((x) => x / Math.max(...xyz))), 2e-4),
        },
        {
            name: 'scratch, footprint', tables: { table: '/tables/footprint.ktx2' }, source: snippet('scratch'),
            result: 'return vec4(irido_scratch_footprint(table, vec2(128.0, 128.0), a.x, a.y, 60.0), 0.0, 0.0, 1.0);',
            points: flat(sides.map(([s, h]) => [s, h])), mayWarn: true,
            check: (values) => largestDifference(rows(values, 1), [[sides[0][2]]], 1e-3),
        },
    ];
}
