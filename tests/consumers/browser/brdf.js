// Tables of BRDFs over half-angle coordinates, against irido's own BRDF at 100 pairs of directions.
import { checkColors, layeredPairs, surfaceFile } from './layered.js';
import { axis, glsl, makeTable, snippet } from './jobs.js';

export function makeJobs(folder) {
    const surface = surfaceFile('beetle-green'), { points, expected } = layeredPairs(folder, surface);
    return ['f16', 'f32'].map((type) => {
        const file = `brdf-${type}.ktx2`, metadata = makeTable(folder, file, 'brdf', surface, '--dtype', type);
        const [phi, half, difference] = metadata.axes;
        return {
            name: type,
            tables: { table: `/tables/${file}` },
            source: snippet('brdf'),
            result: `return vec4(irido_brdf(table, ${axis(phi)}, vec2(${glsl(metadata.request.theta_h_scale_deg)}, ${glsl(half.count)}),
    ${axis(difference)}, a.xyz, vec3(a.w, b.xy)), 1.0);`,
            points,
            check: (values) => checkColors(values, expected, metadata, 3),
        };
    });
}
