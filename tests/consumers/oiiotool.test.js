// OpenEXR files read by OpenImageIO's tools: header, attributes and values.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { describe, it } from 'node:test';
import { irido, numbersIn, readBin, tableMetadata, temporaryFolder, texelBits, writeSamples }
    from './support/irido.js';

const folder = temporaryFolder();

function oiiotool(...args) {
    return execFileSync('oiiotool', args, { encoding: 'utf8', stdio: 'pipe' });
}

const words = ['width', 'height', 'nchannels', 'compression', 'irido.kind', 'irido.error', 'irido.metadata'];

/** Attributes of pictures, by name: all pictures in one run, which takes a third of a second. */
function attributesOf(files) {
    const text = oiiotool(...files.flatMap((file) =>
        [file, ...words.flatMap((word) => ['--echo', `{TOP.'${word}'}`])]));
    const rows = text.trimEnd().split('\n');
    assert.equal(rows.length, files.length * words.length);
    // it writes texts as C does
    return files.map((_, f) => Object.fromEntries(words.map((word, i) =>
        [word, JSON.parse(`"${rows[f * words.length + i]}"`)])));
}

/** Numbers of pictures, through uncompressed TIFFs of 32-bit numbers. */
function valuesOf(files) {
    const copies = files.map((_, i) => `${folder}/copy-${i}.tif`);
    oiiotool(...files.flatMap((file, i) => [file, '-d', 'float', '--compression', 'none', '-o', copies[i]]));
    return copies.map(valuesOfTiff);
}

function valuesOfTiff(file) {
    const bytes = readFileSync(file);
    assert.equal(bytes.toString('latin1', 0, 2), 'II');
    const directory = bytes.readUInt32LE(4), tags = new Map();
    for (let i = 0; i < bytes.readUInt16LE(directory); ++i) {
        const at = directory + 2 + 12 * i;
        const size = bytes.readUInt16LE(at + 2) === 3 ? 2 : 4, count = bytes.readUInt32LE(at + 4);
        const from = size * count <= 4 ? at + 8 : bytes.readUInt32LE(at + 8);
        tags.set(bytes.readUInt16LE(at), { size, count, from });
    }
    const numbers = (tag) => Array.from({ length: tags.get(tag).count }, (_, i) =>
        bytes.readUIntLE(tags.get(tag).from + i * tags.get(tag).size, tags.get(tag).size));
    const stripOffsets = 273, stripSizes = 279, sizes = numbers(stripSizes);
    const strips = numbers(stripOffsets).map((from, i) => bytes.subarray(from, from + sizes[i]));
    return numbersIn(Buffer.concat(strips), 'f32').values;
}

/** Everything that a picture says of `table`, which has the same values. */
function checkPicture({ metadata, bits }, attributes, values) {
    const channels = metadata.channels.length;
    const components = channels === 1 ? 1 : channels === 4 ? 4 : 3;
    const { texels, width, rows } = texelBits({ metadata, bits }, 0, components);
    assert.equal(attributes.width, String(width));
    assert.equal(attributes.height, String(rows));
    assert.equal(attributes.nchannels, String(components));
    assert.equal(attributes.compression, 'zip');
    assert.equal(attributes['irido.kind'], metadata.kind);
    assert.deepEqual(JSON.parse(attributes['irido.error']), metadata.error);
    const inFile = JSON.parse(attributes['irido.metadata']);
    assert.deepEqual(tableMetadata(inFile), metadata);
    assert.equal(inFile.blocks, channels > 4 ? channels / 3 : undefined);
    const third = metadata.axes.length === 3 ? metadata.axes[0].count : 1;
    assert.equal(inFile.stacked, third > 1 ? third : undefined);
    const bytes = Buffer.from((metadata.dtype === 'f16' ? Uint16Array : Uint32Array).from(texels).buffer);
    assert.deepEqual([...values], [...numbersIn(bytes, metadata.dtype).values]);
}

describe('oiiotool reads every layout', () => {
    const names = writeSamples(folder).filter((n) => !/mips|layers|zstd/.test(n));
    const files = names.map((name) => `${folder}/${name}.exr`);
    const attributes = attributesOf(files), values = valuesOf(files);
    names.forEach((name, i) => it(name, () =>
        checkPicture(readBin(`${folder}/${name}.bin`), attributes[i], values[i])));
});

describe('iinfo and oiiotool read tables as irido computes them', () => {
    const film = 'air | 1.33@400 | 1.9+1.5i';
    const requests = {
        cumulative: ['cumulative', '-w', '380:780:10'],
        sensitivity: ['sensitivity', '--opd', '0:4000/64'],
        color: ['color', film, '--cos', '0:1/16', '--vary', 'layers.0.thickness_nm=0:1000/32'],
    };
    for (const [name, request] of Object.entries(requests))
        for (const type of ['f16', 'f32'])
            it(`${name}, ${type}`, () => {
                const file = `${folder}/${name}-${type}.exr`;
                for (const copy of [file, `${file}.bin`])
                    irido('lut', ...request, '--dtype', type, '-o', copy);
                const information = JSON.parse(irido('lut', 'info', file));
                const table = readBin(`${file}.bin`);
                assert.deepEqual(information, table.metadata);
                checkPicture(table, attributesOf([file])[0], valuesOf([file])[0]);
                const text = execFileSync('iinfo', ['-v', file], { encoding: 'utf8' });
                const blocks = information.channels.length / 3;
                const height = information.axes.at(-2)?.count ?? 1;
                assert.match(text, new RegExp(`${blocks * information.axes.at(-1).count} x +${height}, 3 channel, `
                    + `${type === 'f16' ? 'half' : 'float'} openexr`));
                assert.match(text, /channel list: R, G, B/);
                assert.equal(/chromaticities/.test(text), name === 'color');
            });
});
