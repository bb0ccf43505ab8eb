// What the jobs have in common.
import assert from 'node:assert/strict';
import { interpolated, irido, readLevel } from '../support/irido.js';

const sources = new Map();

/** A snippet's GLSL. */
export function snippet(name) {
    if (!sources.has(name)) sources.set(name, irido('lut', 'shader', name));
    return sources.get(name);
}

/** A number as GLSL. */
export function glsl(value) {
    const text = String(Math.fround(value));
    return /[.e]/.test(text) ? text : text + '.0';
}

/** An axis of a table's metadata as the snippets take it. */
export function axis({ first, last, count }) {
    return `vec3(${[first, last, count].map(glsl).join(', ')})`;
}

/** Makes a table in `folder`; its metadata. */
export function makeTable(folder, file, ...args) {
    irido('lut', ...args, '--quiet', '-o', `${folder}/${file}`);
    return JSON.parse(irido('lut', 'info', `${folder}/${file}`));
}

/** Points of up to eight numbers, filled up with zeros. */
export function flat(points) {
    return points.flatMap((point) => [...point, ...new Array(8 - point.length).fill(0)]);
}

/**
 * Sines to the precision of float, before a snippet: those of SwiftShader, which draws here, are off by
 * 2e-4, which GLSL ES allows and graphics cards are far below.
 */
export const goodSines = `vec2 good_sin_cos(float x) {
    float k = floor(x * 0.636619772 + 0.5);
    float r = ((x - k * 1.5703125) - k * 0.000483810901641845703125) - k * 1.58932547735e-8;
    float z = r * r;
    float s = r * (1.0 - z / 6.0 * (1.0 - z / 20.0 * (1.0 - z / 42.0 * (1.0 - z / 72.0))));
    float c = 1.0 - z / 2.0 * (1.0 - z / 12.0 * (1.0 - z / 30.0 * (1.0 - z / 56.0 * (1.0 - z / 90.0))));
    int quarter = int(k) & 3;
    return quarter == 0 ? vec2(s, c) : quarter == 1 ? vec2(c, -s) : quarter == 2 ? vec2(-s, -c) : vec2(-c, s);
}
float good_sin(float x) { return good_sin_cos(x).x; }
float good_cos(float x) { return good_sin_cos(x).y; }
float good_tan(float x) { vec2 both = good_sin_cos(x); return both.x / both.y; }
vec3 good_sin(vec3 v) { return vec3(good_sin(v.x), good_sin(v.y), good_sin(v.z)); }
vec3 good_cos(vec3 v) { return vec3(good_cos(v.x), good_cos(v.y), good_cos(v.z)); }
#define sin good_sin
#define cos good_cos
#define tan good_tan
`;

/** A job with good sines and, unless its bound is null, the same with those of the device. */
export function withBothSines(job, boundGood, boundDevice) {
    const { check, name, source, ...rest } = job;
    const good = { ...rest, name: `${name}, good sines`, source: goodSines + source, check: check(boundGood) };
    const device = { ...rest, name: `${name}, sines of the device`, source, check: check(boundDevice) };
    return boundDevice === null ? [good] : [good, device];
}

/** The texels that came back, as arrays of `channels` numbers. */
export function rows(values, channels) {
    return Array.from({ length: values.length / 4 }, (_, i) => values.slice(4 * i, 4 * i + channels));
}

/** The largest difference of rows of numbers; fails above `bound`. */
export function largestDifference(actual, expected, bound, what = 'points') {
    assert.equal(actual.length, expected.length);
    let largest = 0, at = -1;
    actual.forEach((row, i) => row.forEach((value, c) => {
        assert.ok(Number.isFinite(value), `no number at point ${i}`);
        const difference = Math.abs(value - expected[i][c]);
        if (!(difference <= largest)) [largest, at] = [difference, i];
    }));
    assert.ok(largest <= bound,
        `off by ${largest} at point ${at} (${actual[at]}, not ${expected[at]}), bound ${bound}`);
    return `${actual.length} ${what}, largest error ${largest.toExponential(1)}, bound ${bound.toExponential(1)}`;
}

/**
 * Values of a KTX2 file, interpolated here: what a snippet must find, whatever the table's own error. Each
 * place is one number for each axis that the texture has, `level` may lie between two levels.
 */
export function interpolatedIn(file, places) {
    const levels = new Map();
    const of = (level, place) => {
        if (!levels.has(level)) levels.set(level, readLevel(file, level));
        return interpolated(levels.get(level), place);
    };
    return places.map(({ place, level = 0 }) => {
        const low = Math.floor(level), high = Math.ceil(level);
        return of(low, place).map((value, c) => value + (of(high, place)[c] - value) * (level - low));
    });
}

/** The interpolation error that a table states, of its worst level if it has several. */
export function statedError({ error }) {
    return Math.max(error.value, ...(error.levels ?? []));
}

/** Distance of neighbours of the type around a size. */
export function spacing(type, size) {
    return 2 ** (Math.max(Math.floor(Math.log2(size)), -14) - (type === 'f16' ? 10 : 23));
}
