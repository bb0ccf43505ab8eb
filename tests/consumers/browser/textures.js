// Every layout of a texture, texel by texel, as three.js has put it into the graphics memory.
import assert from 'node:assert/strict';
import { levelOf, numbersIn, readBin, texelBits, writeSamples } from '../support/irido.js';
import { flat } from './jobs.js';

export function makeJobs(folder) {
    // array layers are not here: three keeps the first one only, and irido says so when they are asked for
    return writeSamples(folder).filter((name) => !name.includes('layers')).map((name) => {
        const table = readBin(`${folder}/${name}.bin`), { metadata } = table;
        const channels = metadata.channels.length;
        const components = channels === 3 || channels > 4 ? 4 : channels;
        const levels = metadata.mips ? metadata.axes[0].count : 1;
        const points = [], expected = [];
        let size;
        for (let level = 0; level < levels; ++level) {
            const { texels, width } = texelBits(table, level, components);
            const { counts } = levelOf(metadata, level);
            const height = counts.at(-2) ?? 1, depth = counts.length === 3 && counts[0] > 1 ? counts[0] : 0;
            size ??= { width, height, depth };
            const bits = (metadata.dtype === 'f16' ? Uint16Array : Uint32Array).from(texels);
            const { values } = numbersIn(Buffer.from(bits.buffer), metadata.dtype);
            for (let i = 0; i < values.length / components; ++i) {
                const row = Math.floor(i / width);
                points.push([i % width, row % height, Math.floor(row / height), level]);
                const missing = [0, 0, 0, 1].slice(components);
                expected.push(...values.subarray(i * components, (i + 1) * components), ...missing);
            }
        }
        const place = size.depth ? 'ivec3(a.xyz)' : 'ivec2(a.xy)';
        return {
            name,
            tables: { table: `/tables/${name}.ktx2` },
            result: `return texelFetch(table, ${place}, int(a.w));`,
            points: flat(points),
            check(values, { table: { volume, width, height, depth, levels: found } }) {
                assert.equal(volume, size.depth > 0);
                assert.deepEqual([width, height, depth], [size.width, size.height, size.depth]);
                assert.equal(found, levels);
                assert.deepEqual(values.map((value) => value + 0), expected.map((value) => value + 0));
            },
        };
    });
}
