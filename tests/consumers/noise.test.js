// Procedural thicknesses against three.js, which has Perlin's improved noise as well.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { ImprovedNoise } from 'three/examples/jsm/math/ImprovedNoise.js';
import { irido } from './support/irido.js';

describe('lut thickness', () => {
    const noise = new ImprovedNoise();
    const rowsOf = (...args) => irido('lut', 'thickness', '--dtype', 'f64', ...args)
        .trimEnd().split('\n').slice(1).map((line) => line.split(',').map(Number));

    it('is the noise of three.js, mapped to the range', () => {
        for (const [u, v, thickness] of rowsOf('--noise-scale', '37', '--range', '100:800', '--size', '64'))
            assert.ok(Math.abs(thickness - (450 + 350 * noise.noise(37 * u, 37 * v, 0))) < 1e-10);
    });
    it('adds octaves', () => {
        for (const [u, v, thickness] of rowsOf('--noise-scale', '5', '--octaves', '2', '--range', '0:1', '--size', '64')) {
            const n = (noise.noise(5 * u, 5 * v, 0) + noise.noise(10 * u, 10 * v, 0) / 2) / 1.5;
            assert.ok(Math.abs(thickness - (0.5 + 0.5 * n)) < 1e-13);
        }
    });
});
