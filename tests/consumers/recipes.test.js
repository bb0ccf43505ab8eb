// The recipes of docs/shaders.md, pasted and run: three.js in headless Chromium, and Python.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { describe, it } from 'node:test';
import { runInBrowser } from './support/chromium.js';
import { csv, irido, temporaryFolder } from './support/irido.js';
import { pageBlock } from './support/pages.js';

const stack = '1 | 1.33@400 | 1.9+1.5i', size = 64, thicknesses_nm = [330, 610];
const folder = temporaryFolder();
irido('lut', 'color', stack, '--vary', 'layers.0.thickness_nm=0:1000/2', '--tolerance', '0.1', '--dtype', 'f16',
    '--quiet', '-o', `${folder}/film.ktx2`);
writeFileSync(`${folder}/color.glsl`, irido('lut', 'shader', 'color'));
writeFileSync(`${folder}/film-material.js`, pageBlock('js', 'function filmMaterial'));
writeFileSync(`${folder}/iridescent-material.js`, pageBlock('js', 'function iridescentMaterial'));
const [cosine, nm] = JSON.parse(irido('lut', 'info', `${folder}/film.ktx2`)).axes;

/** Linear RGB of the film, at every angle whose cosine is given. */
function truth(thickness_nm, cosines) {
    const angles = cosines.map((c) => Math.acos(c) * 180 / Math.PI);
    const order = angles.map((_, i) => i).sort((a, b) => angles[a] - angles[b]);
    const rows = csv(irido('color', stack, '--set', `layers.0.thickness_nm=${thickness_nm}`, '-a',
        order.map((i) => angles[i]).join(','), '--quiet'));
    const found = [];
    order.forEach((i, row) => { found[i] = ['r', 'g', 'b'].map((name) => Number(rows[row][name])); });
    return found;
}

describe('the recipes of docs/shaders.md', () => {
    it('three.js: a ShaderMaterial, and MeshPhysicalMaterial with the table', async () => {
        const { said, pixels } = await runInBrowser({ size, axes: { cosine, nm }, thicknesses_nm }, folder,
            { page: 'recipes' });
        assert.deepEqual(said, []);
        const places = [];
        for (let row = 4; row < size; row += 7)
            for (let column = 3; column < size; column += 7) {
                const x = 2 * (column + 0.5) / size - 1, y = 2 * (row + 0.5) / size - 1, z2 = 1 - x * x - y * y;
                if (z2 > 0.1) places.push({ first: 4 * (row * size + column), cosine: Math.sqrt(z2) });
            }
        assert.ok(places.length > 40);
        const at = (image, { first }) => pixels[image].slice(first, first + 3);
        const colors = thicknesses_nm.map((d) => truth(d, places.map((place) => place.cosine)));
        let worst = 0, worstRatio = 0;
        places.forEach((place, i) => {
            for (let c = 0; c < 3; ++c) {
                for (const film of [0, 1])
                    worst = Math.max(worst, Math.abs(at(2 * film, place)[c] - colors[film][i][c]));
                // the same lights and the same roughness: what differs is the film
                if (colors[1][i][c] < 0.05) continue;
                const ratio = at(1, place)[c] / at(3, place)[c], want = colors[0][i][c] / colors[1][i][c];
                worstRatio = Math.max(worstRatio, Math.abs(ratio / want - 1));
            }
        });
        assert.ok(worst < 0.003, `off by ${worst}`);
        assert.ok(worstRatio < 0.02, `off by a ratio of ${worstRatio}`);
    });

    it('Python: a table looked up between its samples', () => {
        irido('lut', 'color', stack, '--vary', 'layers.0.thickness_nm=0:1000/512', '--quiet', '-o', `${folder}/film.npy`);
        const answer = execFileSync('/usr/bin/python3', ['-c', pageBlock('python', 'film.npy')],
            { cwd: folder, encoding: 'utf8' }).trim().split(' ').map(Number);
        const [want] = truth(333, [0.8]);
        answer.forEach((value, c) => assert.ok(Math.abs(value - want[c]) < 0.002, `${value} for ${want[c]}`));
    });
});
