// Every snippet in WGSL through Chromium's own compiler, and run by WebGPU: with the numbers of its GLSL, and
// the layered surfaces of two examples with irido's own at 100 pairs of directions.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { describe, it } from 'node:test';
import { read as readKtx2 } from 'ktx-parse';
import { checkColors, layeredPairs, surfaceFile, wgslNumber } from './browser/layered.js';
import { makeTable } from './browser/jobs.js';
import { runInBrowser } from './support/chromium.js';
import { irido, randomNumbers, temporaryFolder } from './support/irido.js';
import { calls, glslCalled, wgslCalled } from './support/shader-calls.js';

const folder = temporaryFolder(), random = randomNumbers(4), jobs = [];
const points = Array.from({ length: 200 }, () => random(0.02, 0.98));

for (const name of Object.keys(calls))
    jobs.push({
        name: `${name}, as in GLSL`,
        wgsl: wgslCalled(name, irido('lut', 'shader', name, '--language', 'wgsl')),
        glsl: glslCalled(name, irido('lut', 'shader', name)),
        points,
        check({ values, glsl }) {
            const largest = Math.max(...glsl.map(Math.abs));
            assert.ok(largest > 0);
            values.forEach((value, i) => assert.ok(Math.abs(value - glsl[i]) <= 2e-4 * largest,
                `${value}, not ${glsl[i]}, at ${i}`));
        },
    });

for (const [name, layers] of [['green-on-pale', 1], ['blue-over-red', 2]]) {
    const surface = surfaceFile(name);
    const metadata = makeTable(folder, `${name}.ktx2`, 'layered', surface, '--dtype', 'f16');
    const { levels, pixelWidth, pixelHeight } = readKtx2(new Uint8Array(readFileSync(`${folder}/${name}.ktx2`)));
    writeFileSync(`${folder}/${name}.halves`, levels[0].levelData);
    const { alpha, groups, n_outside_per_n_inside: ratio } = metadata.request;
    const axis = ({ first, last, count }) => `vec3f(${[first, last, count].map(wgslNumber)})`;
    const { expected, points: eights } = layeredPairs(folder, surface);
    jobs.push({
        name,
        wgsl: `const IRIDO_LAYERS = ${layers};
@group(0) @binding(0) var table: texture_2d<f32>;
@group(0) @binding(1) var table_sampler: sampler;
${irido('lut', 'shader', 'layered', '--language', 'wgsl')}
fn called_of(a: vec4f, b: vec4f) -> vec4f {
    return vec4f(irido_layered(table, table_sampler, ${metadata.axes.map(axis)}, ${groups},
        array<f32, IRIDO_LAYERS>(${alpha.map(wgslNumber)}), ${wgslNumber(ratio)}, 1.0, a.xyz, vec3f(a.w, b.xy)), 1.0);
}`,
        points: eights,
        table: { url: `/tables/${name}.halves`, width: pixelWidth, height: pixelHeight },
        check: ({ values }) => checkColors(values, expected, metadata),
    });
}

const { adapter, hasDevice, answers } = await runInBrowser(
    jobs.map(({ wgsl, glsl, points: some, table }) => ({ wgsl, glsl, points: some, table })), folder,
    { page: 'wgsl', flags: ['--ignore-gpu-blocklist', '--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader', '--enable-features=Vulkan'] });

describe(`WebGPU on ${adapter}`, () => {
    it('is there', () => assert.ok(hasDevice));
    jobs.forEach(({ name, check }, i) => it(name, (test) => {
        const { error, said, ...found } = answers[i];
        assert.equal(error, undefined);
        assert.deepEqual(said, []);
        const measured = check(found);
        if (measured !== undefined) test.diagnostic(`${name}: ${measured}`);
    }));
});
