// OpenEXR files read by three's EXRLoader, as it would read them for a texture.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { describe, it } from 'node:test';
import { FloatType, HalfFloatType, RedFormat, RGBAFormat } from 'three';
import { EXRLoader } from 'three/examples/jsm/loaders/EXRLoader.js';
import { csvValues, irido, numbersIn, readBin, temporaryFolder, texelBits, writeSamples }
    from './support/irido.js';

const folder = temporaryFolder();

/** What three puts into a texture, rows turned back so that the file's first line is the first. */
function load(file, type, format) {
    const bytes = readFileSync(file);
    const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
    const loader = new EXRLoader().setDataType(type === 'f16' ? HalfFloatType : FloatType);
    if (format) loader.setOutputFormat(format);
    const { data, width, height, flipY, header } = loader.parse(buffer);
    assert.equal(flipY, false);
    const row = data.length / height, rows = [];
    for (let y = height; y-- > 0;) rows.push(...data.subarray(y * row, (y + 1) * row));
    const typed = type === 'f16' ? Uint16Array.from(rows) : new Uint32Array(Float32Array.from(rows).buffer);
    return { width, height, header, bits: typed };
}

/** Texels as three has them: four components a texel, or only the red one. */
function expectedTexels(table, format) {
    const channels = table.metadata.channels.length;
    const one = table.metadata.dtype === 'f16' ? 0x3c00 : 0x3f800000;
    const components = channels === 1 ? 1 : channels === 4 ? 4 : 3;
    const { texels, width, rows } = texelBits(table, 0, components);
    const result = [];
    for (let i = 0; i < texels.length; i += components) {
        const texel = texels.slice(i, i + components);
        if (format === RedFormat) result.push(texel[0]);
        else if (components === 1) result.push(texel[0], texel[0], texel[0], one);
        else result.push(...texel, ...(components === 3 ? [one] : []));
    }
    return { texels: result, width, rows };
}

function checkFile(file, table, format = RGBAFormat) {
    const loaded = load(file, table.metadata.dtype, format);
    const expected = expectedTexels(table, format);
    assert.equal(loaded.width, expected.width);
    assert.equal(loaded.height, expected.rows);
    assert.deepEqual([...loaded.bits], expected.texels);
    assert.equal(loaded.header['irido.kind'], table.metadata.kind);
}

describe("three's EXRLoader reads every layout", () => {
    for (const name of writeSamples(folder).filter((n) => !/mips|layers|zstd/.test(n))) {
        const table = readBin(`${folder}/${name}.bin`);
        it(name, () => checkFile(`${folder}/${name}.exr`, table));
        if (table.metadata.channels.length === 1)
            it(`${name} as red alone`, () => checkFile(`${folder}/${name}.exr`, table, RedFormat));
    }
});

describe("three's EXRLoader reads tables as irido computes them", () => {
    const film = 'air | 1.33@400 | 1.9+1.5i';
    const vary = ['--vary', 'layers.0.thickness_nm=0:1000/32'];
    const requests = {
        cumulative: ['cumulative', '-w', '380:780:10'],
        sensitivity: ['sensitivity', '--opd', '0:4000/64', '--sigma', '0,50'],
        color: ['color', film, '--cos', '0:1/16', ...vary],
        'color with spreads': ['color', film, '--cos', '0:1/4', ...vary, '--sigma', '0,20'],
    };
    for (const [name, request] of Object.entries(requests))
        for (const type of ['f16', 'f32'])
            it(`${name}, ${type}`, () => {
                const file = `${folder}/irido-${type}`;
                for (const format of ['exr', 'bin'])
                    irido('lut', ...request, '--dtype', type, '-o', `${file}.${format}`);
                const table = readBin(`${file}.bin`);
                checkFile(`${file}.exr`, table);
                const text = irido('lut', ...request, '--dtype', type);
                assert.deepEqual(csvValues(text, table.metadata.axes.length), [...table.values]);
            });

    it('puts the first sample at v = 1', () => {
        const file = `${folder}/rows.exr`;
        irido('lut', 'color', film, '--cos', '0:1/4', ...vary, '-o', file);
        const { r } = irido('color', film, '--set', 'layers.0.thickness_nm=0', '-a', '90').trim()
            .split('\n').map((line) => line.split(','))
            .reduce((names, row) => Object.fromEntries(names.map((n, i) => [n, row[i]])));
        const bytes = readFileSync(file);
        const { data, width, height } = new EXRLoader().setDataType(FloatType)
            .parse(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
        // cos 0 is a mirror; data begin at v = 0, three's lowest row
        assert.equal(data[4 * width * (height - 1)], Math.fround(r));
        assert.notEqual(data[0], Math.fround(r));
    });
});
