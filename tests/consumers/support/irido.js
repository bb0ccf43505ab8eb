// Runs the built program and reads its plain formats (bin, CSV) without any library.
import { execFile, execFileSync, spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { availableParallelism, tmpdir } from 'node:os';
import { join } from 'node:path';
import { promisify } from 'node:util';
import { read as readKtx2 } from 'ktx-parse';

function fromEnvironment(name) {
    const value = process.env[name];
    if (!value) throw new Error(`${name} is not set: run ./dev test --consumers`);
    return value;
}

export const program = fromEnvironment('IRIDO');
for (const signal of ['SIGINT', 'SIGTERM']) process.on(signal, () => process.exit(1));

/** Standard output of the program; throws with its message when it fails. */
export function irido(...args) {
    return execFileSync(program, args.map(String), { encoding: 'utf8', stdio: 'pipe' });
}

/** Status, standard output and standard error of the program. */
export function run(...args) {
    return spawnSync(program, args.map(String), { encoding: 'utf8' });
}

/** Standard output of many command lines, as many at a time as there are cores. */
export async function iridoEach(commands) {
    const start = promisify(execFile);
    const results = new Array(commands.length);
    let next = 0;
    const work = async () => {
        while (next < commands.length) {
            const i = next++;
            results[i] = (await start(program, commands[i].map(String))).stdout;
        }
    };
    await Promise.all(Array.from({ length: availableParallelism() }, work));
    return results;
}

/** An empty folder that is gone when the process ends, however it ends. */
export function temporaryFolder() {
    const folder = mkdtempSync(join(tmpdir(), 'irido-consumers-'));
    process.on('exit', () => rmSync(folder, { recursive: true, force: true, maxRetries: 5 }));
    return folder;
}

/** Makes the tables of every layout that the unit tests have; returns their names. */
export function writeSamples(folder) {
    execFileSync(fromEnvironment('IRIDO_TESTS'), ['[.consumers]'], {
        stdio: 'pipe',
        env: { ...process.env, IRIDO_SAMPLES: folder },
    });
    return readdirSync(folder).filter((name) => name.endsWith('.ktx2'))
        .map((name) => name.slice(0, -'.ktx2'.length)).sort();
}

/** The kinds of tables that this program makes. */
export const kinds = new Set(irido('lut', 'list').trim().split('\n').slice(1)
    .map((line) => line.split(',')[0]));

/** Rows of a CSV of numbers as objects. */
export function csv(text) {
    const [names, ...lines] = text.trim().split('\n').map((line) => line.split(','));
    return lines.map((line) => Object.fromEntries(line.map((cell, i) => [names[i], cell])));
}

/** Values of a table's CSV without its axes, line by line. */
export function csvValues(text, axes) {
    const values = text.trim().split('\n').slice(1)
        .flatMap((line) => line.split(',').slice(axes).map(Number));
    if (!values.length || !values.every(Number.isFinite)) throw new Error('this is no CSV of numbers');
    return values;
}

export function halfToNumber(bits) {
    const sign = bits & 0x8000 ? -1 : 1, exponent = bits >> 10 & 31, fraction = bits & 1023;
    if (exponent === 0) return sign * fraction * 2 ** -24;
    if (exponent === 31) return fraction ? NaN : sign * Infinity;
    return sign * (1024 + fraction) * 2 ** (exponent - 25);
}

/** Numbers in little-endian bytes, and their bits. */
export function numbersIn(bytes, type) {
    const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
    if (type === 'f16') {
        const bits = new Uint16Array(buffer);
        return { bits, values: Float64Array.from(bits, halfToNumber) };
    }
    if (type === 'f32')
        return { bits: new Uint32Array(buffer), values: Float64Array.from(new Float32Array(buffer)) };
    return { bits: new BigUint64Array(buffer), values: new Float64Array(buffer) };
}

/** A table from its raw file and the companion: metadata, raw bytes, bits and values. */
export function readBin(file) {
    const metadata = JSON.parse(readFileSync(file + '.json', 'utf8'));
    const bytes = readFileSync(file);
    return { metadata, bytes, ...numbersIn(bytes, metadata.dtype) };
}

/** Counts along the axes of one level without that of the levels; where its values start. */
export function levelOf(metadata, level) {
    const axes = metadata.mips ? metadata.axes.slice(1) : metadata.axes;
    const countsAt = (l) => axes.map((axis) => Math.max(1, axis.count >> l));
    const size = (l) => countsAt(l).reduce((a, b) => a * b, metadata.channels.length);
    let start = 0;
    for (let l = 0; l < level; ++l) start += size(l);
    return { counts: countsAt(level), start, size: size(level) };
}

/**
 * Bits of the texels of one level: channels side by side in blocks of three if there are more than
 * four; `components` numbers a texel, missing ones 0, a missing fourth 1.
 */
export function texelBits({ metadata, bits }, level, components) {
    const channels = metadata.channels.length;
    const blocks = channels > 4 ? channels / 3 : 1, inBlock = channels / blocks;
    const { counts, start } = levelOf(metadata, level);
    const width = counts.at(-1), rows = counts.slice(0, -1).reduce((a, b) => a * b, 1);
    const one = metadata.dtype === 'f16' ? 0x3c00 : 0x3f800000;
    const texels = [];
    for (let row = 0; row < rows; ++row)
        for (let block = 0; block < blocks; ++block)
            for (let x = 0; x < width; ++x)
                for (let c = 0; c < components; ++c)
                    texels.push(c < inBlock
                        ? bits[start + (row * width + x) * channels + block * inBlock + c]
                        : c === 3 ? one : 0);
    return { texels, width: blocks * width, rows };
}

/** Multilinear interpolation of a table at one value for each axis; all channels. */
export function interpolated({ metadata, values }, at) {
    const channels = metadata.channels.length;
    let corners = [{ index: 0, weight: 1 }];
    metadata.axes.forEach((axis, a) => {
        const t = axis.count > 1
            ? Math.min(Math.max((at[a] - axis.first) / (axis.last - axis.first), 0), 1) * (axis.count - 1)
            : 0;
        const low = Math.min(Math.floor(t), Math.max(axis.count - 2, 0));
        corners = corners.flatMap(({ index, weight }) => [0, 1]
            .map((i) => ({ index: index * axis.count + low + i, weight: weight * (i ? t - low : 1 - t + low) }))
            .filter((corner) => corner.weight > 0));
    });
    return Array.from({ length: channels }, (_, c) =>
        corners.reduce((sum, { index, weight }) => sum + weight * values[index * channels + c], 0));
}

/** One level of a KTX2 file as a table of its own, without the axis of the levels. */
export function readLevel(file, level = 0) {
    const container = readKtx2(new Uint8Array(readFileSync(file)));
    const metadata = JSON.parse(new TextDecoder().decode(container.keyValue['irido.metadata']));
    const { counts } = levelOf(metadata, level);
    const axes = (metadata.mips ? metadata.axes.slice(1) : metadata.axes)
        .map((axis, a) => ({ ...axis, count: counts[a] }));
    const channels = metadata.channels.length, blocks = channels > 4 ? channels / 3 : 1;
    const inBlock = channels / blocks, components = inBlock === 3 ? 4 : inBlock;
    const texels = numbersIn(container.levels[level].levelData, metadata.dtype).values;
    const width = counts.at(-1), rows = texels.length / (blocks * width * components), values = [];
    for (let row = 0; row < rows; ++row)
        for (let x = 0; x < width; ++x)
            for (let block = 0; block < blocks; ++block) {
                const at = ((row * blocks + block) * width + x) * components;
                values.push(...texels.subarray(at, at + inBlock));
            }
    return { metadata: { ...metadata, axes }, values };
}

/** A repeatable sequence of numbers in [0, 1). */
export function randomNumbers(seed) {
    let state = seed >>> 0;
    return (low = 0, high = 1) => {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        return low + (high - low) * (state / 2 ** 32);
    };
}

/** Metadata without what a file's layout adds to it. */
export function tableMetadata(metadata) {
    const { blocks, stacked, ...rest } = metadata;
    return rest;
}
