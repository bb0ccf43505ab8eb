// Files of BRDFs by readers that share nothing with irido, byte for byte, against irido's own values.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { describe, it } from 'node:test';
import { csv, irido, randomNumbers, temporaryFolder } from './support/irido.js';
import { direction, measuredBsdf, readMerl, readTensorFile } from './support/measured.js';

const folder = temporaryFolder(), film = `${folder}/film.json`;
writeFileSync(film, JSON.stringify({
    layers: [{ stack: '1 | 1.5@300 | 1', alpha: 0.3 }], base: { albedo: [[400, 0.2], [700, 0.4]] },
}));

/** Rows of irido brdf for pairs of polar angles and the azimuth between them. */
function brdf(pairs, ...args) {
    const file = `${folder}/pairs.csv`;
    writeFileSync(file, ['light_theta_deg,light_phi_deg,view_theta_deg,view_phi_deg',
        ...pairs.map(([ti, to, phi]) => [ti, 20, to, 20 + phi].join())].join('\n'));
    return csv(irido('brdf', film, '--directions', file, ...args));
}

const random = randomNumbers(7);
const pairs = Array.from({ length: 200 }, () => [random(0, 75), random(0, 75), random(0, 180)]);
const between = ([ti, to, phi]) => [direction(ti, 20), direction(to, 20 + phi)];

describe('MERL', () => {
    irido('lut', 'brdf', film, '--quiet', '-o', `${folder}/film.binary`);
    const merl = readMerl(readFileSync(`${folder}/film.binary`));
    it('cells hold the BRDF at their middles', () => {
        const cells = [], middles = [];
        while (cells.length < 300) {
            const index = Math.floor(random(0, merl.count)), rgb = merl.cell(index);
            const h = Math.floor(index / 16200), d = Math.floor(index / 180) % 90, p = index % 180;
            const [th, td, pd] = [(h + 0.5) ** 2 / 90, d + 0.5, p + 0.5].map((value) => value * Math.PI / 180);
            const at = [Math.sin(td) * Math.cos(pd), Math.sin(td) * Math.sin(pd), Math.cos(td)];
            const turned = ([x, y, z]) => [Math.cos(th) * x + Math.sin(th) * z, y, Math.cos(th) * z - Math.sin(th) * x];
            const [i, o] = [turned(at), turned([-at[0], -at[1], at[2]])];
            if (Math.min(i[2], o[2]) < -0.05)  // farther below the horizon than a cell reaches
                assert.ok(rgb.every((value) => value < 0), `cell ${index} is below the horizon: ${rgb}`);
            if (Math.min(i[2], o[2]) < 0.01) continue;
            const degrees = (radians) => radians * 180 / Math.PI;
            const phi = Math.abs(degrees(Math.atan2(i[0] * o[1] - i[1] * o[0], i[0] * o[0] + i[1] * o[1])));
            cells.push(rgb);
            middles.push([degrees(Math.acos(i[2])), degrees(Math.acos(o[2])), phi]);
        }
        brdf(middles, '--color').forEach(({ r, g, b }, k) => [r, g, b].forEach((value, c) => {
            const expected = Math.max(0, Number(value)) / Math.PI;
            assert.ok(Math.abs(cells[k][c] - expected) <= 2e-3 * expected + 1e-5, `${cells[k]}, not ${[r, g, b]} / pi`);
        }));
    });
    it('pairs of directions find their cells', (test) => {
        const errors = brdf(pairs, '--color').flatMap(({ r, g, b }, k) => {
            const [i, o] = between(pairs[k]), rgb = merl.at(i, o);
            return [r, g, b].map((value, c) => Math.abs(rgb[c] * Math.PI / Number(value) - 1));
        }).sort((a, b) => a - b);
        test.diagnostic(`relative errors: median ${errors[300].toFixed(4)}, largest ${errors.at(-1).toFixed(3)}`);
        assert.ok(errors[300] < 0.02 && errors[570] < 0.08);
    });
});

describe('tensor file', () => {
    const wavelengths = [400, 500, 600, 700];
    irido('lut', 'brdf', film, '-w', wavelengths.join(), '--quiet', '-o', `${folder}/film.bsdf`);
    const bytes = readFileSync(`${folder}/film.bsdf`), { fields, end } = readTensorFile(bytes);
    it('every byte belongs to a field or fills up to 8', () => {
        const blocks = Object.values(fields).sort((a, b) => a.offset - b.offset);
        let at = end;
        for (const { offset, bytes: size } of blocks) {
            assert.equal(offset, Math.ceil(at / 8) * 8);
            assert.ok(bytes.subarray(at, offset).every((byte) => byte === 0));
            at = offset + size;
        }
        assert.equal(Math.ceil(at / 8) * 8, Math.ceil(bytes.length / 8) * 8);
    });
    it('has the fields that readers ask for', () => {
        const { theta_i: theta, phi_i: phi, spectra, luminance, vndf, ndf, sigma } = fields;
        assert.equal(phi.shape[0], 1);
        const T = theta.shape[0], [, , W, N] = spectra.shape;
        assert.deepEqual(spectra.shape, [1, T, W, N, N]);
        assert.deepEqual(luminance.shape, [1, T, N, N]);
        assert.deepEqual(vndf.shape.slice(0, 2), [1, T]);
        assert.deepEqual(ndf.shape, sigma.shape);
        assert.deepEqual([...fields.wavelengths.numbers], wavelengths);
        assert.deepEqual([fields.jacobian.type, bytes[fields.jacobian.offset]], [1, 1]);
        for (let t = 1; t < T; ++t) assert.ok(theta.numbers[t] > theta.numbers[t - 1]);
        for (const name of ['spectra', 'luminance', 'vndf', 'ndf', 'sigma'])
            assert.ok(fields[name].numbers.every((value) => value >= 0 && Number.isFinite(value)), name);
    });
    it('evaluates to the BRDF', (test) => {
        const bsdf = measuredBsdf(fields);
        const errors = brdf(pairs, '-w', wavelengths.join()).map(({ brdf_per_sr: value }, row) => {
            const pair = pairs[Math.floor(row / 4)], [i, o] = between(pair);
            return Math.abs(bsdf(i, o, row % 4) / (Number(value) * o[2]) - 1);
        }).sort((a, b) => a - b);
        test.diagnostic(`relative errors: median ${errors[400].toFixed(4)}, largest ${errors.at(-1).toFixed(3)}`);
        assert.ok(errors[400] < 0.01 && errors[760] < 0.05);
    });
});
