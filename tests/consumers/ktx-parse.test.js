// KTX2 files read by ktx-parse: header, descriptor, keys, and every texel.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { describe, it } from 'node:test';
import { read } from 'ktx-parse';
import { ZSTDDecoder } from 'three/examples/jsm/libs/zstddec.module.js';
import { csvValues, irido, levelOf, numbersIn, readBin, run, tableMetadata, temporaryFolder, texelBits,
    writeSamples } from './support/irido.js';

const folder = temporaryFolder();
const zstd = new ZSTDDecoder();
await zstd.init();

const vkFormats = { f16: { 1: 76, 2: 83, 4: 97 }, f32: { 1: 100, 2: 103, 4: 109 } };
const primaries = { srgb: 1, rec2020: 4, xyz: 5, acescg: 7, 'display-p3': 10 };

function levelBytes(container, level) {
    const { levelData, uncompressedByteLength } = container.levels[level];
    return container.supercompressionScheme ? zstd.decode(levelData, uncompressedByteLength) : levelData;
}

/** Everything that a file says of `table`, which has the same values. */
function checkFile(file, table, { layers = false, isCompressed = false } = {}) {
    const { metadata } = table;
    const bytes = readFileSync(file);
    const container = read(new Uint8Array(bytes));
    const channels = metadata.channels.length;
    const components = channels === 3 || channels > 4 ? 4 : channels;
    const component = metadata.dtype === 'f16' ? 2 : 4, texel = component * components;
    const axes = metadata.mips ? metadata.axes.slice(1) : metadata.axes;
    const third = axes.length === 3 ? axes[0].count : 0;

    assert.equal(container.vkFormat, vkFormats[metadata.dtype][components]);
    assert.equal(container.typeSize, component);
    assert.equal(container.pixelWidth, texelBits(table, 0, components).width);
    assert.equal(container.pixelHeight, axes.at(-2)?.count ?? 1);
    assert.equal(container.pixelDepth, !layers && third > 1 ? third : 0);
    assert.equal(container.layerCount, layers ? third : 0);
    assert.equal(container.faceCount, 1);
    assert.equal(container.levelCount, metadata.mips ? metadata.axes[0].count : 1);
    assert.equal(container.levels.length, container.levelCount);
    assert.equal(container.supercompressionScheme, isCompressed ? 2 : 0);

    const [descriptor, ...others] = container.dataFormatDescriptor;
    assert.equal(others.length, 0);
    assert.equal(descriptor.vendorId, 0);
    assert.equal(descriptor.descriptorType, 0);
    assert.equal(descriptor.colorModel, 1);
    assert.equal(descriptor.colorPrimaries, primaries[metadata.color_space] ?? 0);
    assert.equal(descriptor.transferFunction, 1);
    assert.deepEqual([...descriptor.texelBlockDimension], [0, 0, 0, 0]);
    assert.equal(descriptor.bytesPlane[0], texel);
    assert.equal(descriptor.samples.length, components);
    descriptor.samples.forEach((sample, c) => {
        assert.equal(sample.bitOffset, 8 * component * c);
        assert.equal(sample.bitLength, 8 * component - 1);
        assert.equal(sample.channelType, 0xc0 | (c === 3 ? 15 : c));
    });

    assert.deepEqual(Object.keys(container.keyValue), ['KTXorientation', 'KTXwriter', 'irido.metadata']);
    assert.equal(container.keyValue.KTXorientation, container.pixelDepth ? 'rdi' : 'rd');
    assert.match(container.keyValue.KTXwriter, /^irido \d+\.\d+\.\d+$/);
    const inFile = JSON.parse(new TextDecoder().decode(container.keyValue['irido.metadata']));
    assert.deepEqual(tableMetadata(inFile), metadata);
    assert.equal(inFile.blocks, channels > 4 ? channels / 3 : undefined);

    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    let end = bytes.length;
    for (let level = 0; level < container.levelCount; ++level) {
        const [offset, length, plain] =
            [0, 8, 16].map((at) => Number(view.getBigUint64(80 + 24 * level + at, true)));
        const expected = texelBits(table, level, components);
        if (!isCompressed) assert.equal(offset % Math.max(4, texel), 0);
        assert.ok(offset + length <= end, 'the smallest level is first');
        end = offset;
        assert.equal(plain, expected.texels.length * component);
        if (!isCompressed) assert.equal(length, plain);
        const { bits } = numbersIn(levelBytes(container, level), metadata.dtype);
        assert.deepEqual([...bits], expected.texels);
    }
}

describe('ktx-parse reads every layout', () => {
    for (const name of writeSamples(folder))
        it(name, () => checkFile(`${folder}/${name}.ktx2`, readBin(`${folder}/${name}.bin`), {
            layers: name.includes('layers'),
            isCompressed: name.includes('zstd'),
        }));
});

describe('ktx-parse reads tables as irido computes them', () => {
    const film = 'air | 1.33@400 | 1.9+1.5i';
    const thickness = ['--vary', 'layers.0.thickness_nm=0:1000/16'];
    const index = ['--vary', 'substrate.n=1.3:2/4'];
    const requests = {
        'cumulative': ['cumulative', '-w', '380:780:10'],
        'sensitivity': ['sensitivity', '--opd', '0:4000/64'],
        'sensitivity-real': ['sensitivity', '--opd', '0:4000/64', '--real'],
        'sensitivity-spreads': ['sensitivity', '--opd', '0:4000/64', '--sigma', '0,40,80'],
        'sensitivity-carrier': ['sensitivity', '--opd', '0:4000/64', '--sigma', '0,40', '--carrier'],
        'color-angle': ['color', film, '--cos', '0:1/16'],
        'color': ['color', film, '--cos', '0:1/16', ...thickness],
        'color-xyz': ['color', film, '--cos', '0:1/16', ...thickness, '--space', 'xyz'],
        'color-theta': ['color', film, '--theta', '0:90/16', ...thickness],
        'color-two': ['color', film, '--cos', '0:1/4', ...thickness, ...index],
        'color-spreads': ['color', film, '--cos', '0:1/8', ...thickness, '--sigma', '0,20,40'],
    };
    for (const [name, request] of Object.entries(requests))
        for (const type of ['f16', 'f32'])
            for (const compression of [[], ['--zstd']])
                it([name, type, ...compression].join(' '), () => {
                    const file = `${folder}/${name}-${type}.ktx2`;
                    const args = ['--dtype', type, '--quiet'];
                    irido('lut', ...request, ...args, ...compression, '-o', file);
                    assert.equal(irido('lut', 'check', file), `${file}: ok\n`);
                    const table = { metadata: JSON.parse(irido('lut', 'info', file)) };
                    table.values = levelValues(name, request, args, table.metadata);
                    table.bits = bitsOf(table.values, type);
                    assert.equal(table.metadata.mips ?? false, name.includes('spreads')
                        || name.includes('carrier'));
                    checkFile(file, table, { isCompressed: compression.length > 0 });
                });

    for (const [name, request] of Object.entries(requests))
        it(`${name}: nothing by default that three.js gets wrong without a word`, () => {
            const file = `${folder}/default.ktx2`;
            irido('lut', ...request, '--quiet', '-o', file);
            const { pixelHeight, pixelDepth, levelCount, layerCount, supercompressionScheme, vkFormat } =
                read(new Uint8Array(readFileSync(file)));
            assert.ok(pixelHeight > 0, 'a 1D texture has no height there');
            assert.equal(layerCount, 0);
            assert.ok(pixelDepth === 0 || levelCount === 1, 'levels of a volume are not uploaded');
            assert.equal(supercompressionScheme, 0);
            assert.equal(vkFormat, vkFormats.f32[4]);
        });

    it('says what three.js does with array layers', () => {
        const { status, stderr } = run('lut', ...requests['color-two'], '--layers', '-o', `${folder}/layers.ktx2`);
        assert.equal(status, 0);
        assert.match(stderr, /three\.js reads only the first array layer of a file/);
    });

    /** The values from CSV files; of mip levels, each from a table of its own. */
    function levelValues(name, request, args, metadata) {
        if (!metadata.mips) {
            const text = irido('lut', ...request, ...args);
            return csvValues(text, metadata.axes.length);
        }
        const sigmas = request[request.indexOf('--sigma') + 1].split(',');
        return sigmas.flatMap((sigma, level) => {
            const { counts } = levelOf(metadata, level);
            const isColor = name.startsWith('color');
            const size = (isColor ? counts : [1, ...counts]).join('x');
            const own = request.map((arg, i) => request[i - 1] === '--sigma' ? sigma : arg);
            return csvValues(irido('lut', ...own, ...args, '--size', size), counts.length + !isColor);
        });
    }

    function bitsOf(values, type) {
        if (type === 'f32') return new Uint32Array(new Float32Array(values).buffer);
        return Uint16Array.from(values, numberToHalf);
    }

    /** Of a number that is a half. */
    function numberToHalf(value) {
        const sign = value < 0 || Object.is(value, -0) ? 0x8000 : 0, size = Math.abs(value);
        if (size === 0) return sign;
        const exponent = Math.max(Math.floor(Math.log2(size)), -14);
        const fraction = size / 2 ** (exponent - 10);
        assert.ok(Number.isInteger(fraction) && fraction < 2048, `${value} is no half`);
        return sign + (fraction < 1024 ? fraction : (exponent + 15 << 10) + fraction - 1024);
    }
});