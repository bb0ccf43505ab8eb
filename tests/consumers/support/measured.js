// Readers of the files of measured BRDFs, written from the descriptions of the formats alone: MERL's isotropic
// .binary, and the tensor file of the RGL database as Mitsuba's and pbrt's measured materials evaluate it.

/** A direction from its polar angle and azimuth in degrees. */
export function direction(theta, phi) {
    const [t, p] = [theta * Math.PI / 180, phi * Math.PI / 180];
    return [Math.sin(t) * Math.cos(p), Math.sin(t) * Math.sin(p), Math.cos(t)];
}

function half(i, o) {
    const sum = i.map((value, k) => value + o[k]), length = Math.hypot(...sum);
    return sum.map((value) => value / length);
}

/** { cells, at(i, o) }: all cells as [red, green, blue] of their index, and the RGB of a pair. */
export function readMerl(bytes) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const [nh, nd, np] = [0, 4, 8].map((offset) => view.getInt32(offset, true));
    if (nh !== 90 || nd !== 90 || np !== 180) throw new Error(`the counts are ${[nh, nd, np]}`);
    const count = nh * nd * np, scale = [1 / 1500, 1.15 / 1500, 1.66 / 1500];
    if (bytes.length !== 12 + 24 * count) throw new Error(`the file has ${bytes.length} bytes`);
    const cell = (index) => scale.map((factor, c) => factor * view.getFloat64(12 + 8 * (c * count + index), true));
    const clamp = (place, last) => Math.min(Math.max(Math.floor(place), 0), last);
    return {
        count, cell,
        at(i, o) {
            const h = half(i, o), theta = Math.acos(Math.min(1, h[2])), phi = Math.atan2(h[1], h[0]);
            const x = Math.cos(phi) * i[0] + Math.sin(phi) * i[1], y = -Math.sin(phi) * i[0] + Math.cos(phi) * i[1];
            const dx = Math.cos(theta) * x - Math.sin(theta) * i[2], dz = Math.sin(theta) * x + Math.cos(theta) * i[2];
            const turn = Math.atan2(y, dx), degrees = 180 / Math.PI;
            const ih = clamp(Math.sqrt(theta * degrees * 90), 89), id = clamp(Math.acos(Math.min(1, dz)) * degrees, 89);
            const ip = clamp((turn < 0 ? turn + Math.PI : turn) * degrees, 179);
            return cell((ih * 90 + id) * 180 + ip);
        },
    };
}

const sizes = { 1: 1, 2: 1, 3: 2, 4: 2, 5: 4, 6: 4, 7: 8, 8: 8, 9: 2, 10: 4, 11: 8 };

/** The fields of a tensor file: { name: { shape, type, offset, bytes, numbers } }; the table's end. */
export function readTensorFile(bytes) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const text = (from, length) => new TextDecoder().decode(bytes.subarray(from, from + length));
    if (text(0, 12) !== 'tensor_file\0' || bytes[12] !== 1 || bytes[13] !== 0) throw new Error('no tensor file 1.0');
    const fields = {};
    let at = 18;
    for (let left = view.getUint32(14, true); left > 0; --left) {
        const length = view.getUint16(at, true), name = text(at + 2, length);
        at += 2 + length;
        const dimensions = view.getUint16(at, true), type = view.getUint8(at + 2);
        const offset = Number(view.getBigUint64(at + 3, true)), shape = [];
        at += 11;
        for (let d = 0; d < dimensions; ++d, at += 8) shape.push(Number(view.getBigUint64(at, true)));
        const count = shape.reduce((product, size) => product * size, 1);
        const field = { shape, type, offset, bytes: count * sizes[type] };
        if (type === 10) field.numbers = new Float32Array(Uint8Array.prototype.slice.call(bytes, offset, offset + 4 * count).buffer);
        fields[name] = field;
    }
    return { fields, end: at };
}

/** The spectral BSDF of an isotropic file: (i, o, wavelength's index) to the BRDF times cos(theta_o). */
export function measuredBsdf(fields) {
    const nodes = fields.vndf.shape[3], samples = fields.spectra.shape[4], thetas = fields.theta_i.numbers;
    const mix = (a, b, t) => a + t * (b - a);
    const cellOf = (place, count) => {
        const k = Math.min(Math.floor(place * (count - 1)), count - 2);
        return [k, place * (count - 1) - k];
    };
    const along = (name, x) => {
        const [k, u] = cellOf(x, fields[name].shape[1]);
        return mix(fields[name].numbers[k], fields[name].numbers[k + 1], u);
    };
    /** Integral of a row of visible normals up to x, in units of the nodes' distance. */
    const rowSum = (t, j, x) => {
        const row = fields.vndf.numbers.subarray((t * nodes + j) * nodes, (t * nodes + j + 1) * nodes);
        const [last, u] = cellOf(x, nodes);
        let sum = 0;
        for (let k = 0; k < last; ++k) sum += 0.5 * (row[k] + row[k + 1]);
        return sum + u * row[last] + 0.5 * u * u * (row[last + 1] - row[last]);
    };
    const warped = (t, x, y) => {
        const [j, v] = cellOf(y, nodes), totals = Array.from({ length: nodes }, (_, k) => rowSum(t, k, 1));
        let all = 0, below = 0;
        for (let k = 0; k + 1 < nodes; ++k) {
            if (k === j) below = all + v * totals[j] + 0.5 * v * v * (totals[j + 1] - totals[j]);
            all += 0.5 * (totals[k] + totals[k + 1]);
        }
        return { sy: below / all, part: mix(rowSum(t, j, x), rowSum(t, j + 1, x), v) / all, whole: mix(totals[j], totals[j + 1], v) / all };
    };
    const spectrum = (t, w, sx, sy) => {
        const grid = fields.spectra.numbers, first = (t * fields.spectra.shape[2] + w) * samples * samples;
        const [i, u] = cellOf(sx, samples), [j, v] = cellOf(sy, samples);
        const row = (k) => mix(grid[first + k * samples + i], grid[first + k * samples + i + 1], u);
        return mix(row(j), row(j + 1), v);
    };
    return (i, o, wavelength) => {
        const m = half(i, o), theta = Math.acos(Math.min(1, i[2]));
        const turn = Math.atan2(m[1], m[0]) - Math.atan2(i[1], i[0]);
        const x = Math.sqrt(2 * Math.acos(Math.min(1, m[2])) / Math.PI);
        const y = turn / (2 * Math.PI) + 0.5 - Math.floor(turn / (2 * Math.PI) + 0.5);
        let t = 0;
        while (t + 2 < thetas.length && thetas[t + 1] <= theta) ++t;
        const share = Math.min(Math.max((theta - thetas[t]) / (thetas[t + 1] - thetas[t]), 0), 1);
        const [a, b] = [warped(t, x, y), warped(t + 1, x, y)];
        const sx = mix(a.part, b.part, share) / mix(a.whole, b.whole, share), sy = mix(a.sy, b.sy, share);
        const value = mix(spectrum(t, wavelength, sx, sy), spectrum(t + 1, wavelength, sx, sy), share);
        return value * along('ndf', x) / (4 * along('sigma', Math.sqrt(2 * theta / Math.PI)));
    };
}
