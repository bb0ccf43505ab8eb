// A baked scene as an engine reads it: the page has manifest.json, the tables that it names and the
// snippets that it names, and draws spheres. What its pixels show is compared with irido's colours.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { describe, it } from 'node:test';
import { fileURLToPath } from 'node:url';
import { deltaE2000, labFromSrgb } from './support/color.js';
import { runInBrowser } from './support/chromium.js';
import { csv, irido, iridoEach, randomNumbers, temporaryFolder } from './support/irido.js';

const scene = fileURLToPath(new URL('../../schemas/examples/scenes/vehicle.json', import.meta.url));
const size = 240, radius = 0.95, pointsEach = 30;
const shown = ['paint', 'rim', 'headlamp'];

const folder = temporaryFolder();
irido('bake', scene, '--quiet', '-o', folder);
const manifest = JSON.parse(readFileSync(`${folder}/manifest.json`, 'utf8'));
const snippets = Object.fromEntries(shown.flatMap((name) => manifest.materials[name].snippets)
    .map((name) => [name, irido('lut', 'shader', name)]));
const { version, said, pixels } = await runInBrowser({ size, materials: shown, snippets }, folder, { page: 'scene' });

const decoded = (v) => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
const encoded = (v) => v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055;

/** Points of a sphere that the scene's angles reach, with the pixel that shows them. */
function places(name, seed) {
    const { angles_deg: [, largest] } = manifest.materials[name];
    const random = randomNumbers(seed), found = [], at = shown.indexOf(name);
    while (found.length < pointsEach) {
        const column = Math.floor(random(0, size)), row = Math.floor(random(0, size));
        const x = (2 * (column + 0.5) / size - 1) / radius, y = (2 * (row + 0.5) / size - 1) / radius;
        const cosine = Math.sqrt(1 - x * x - y * y);
        if (!(cosine > Math.cos(largest * Math.PI / 180) + 0.02)) continue;
        const first = 4 * (row * size * shown.length + at * size + column);
        found.push({ cosine, t: 0.5 + 0.5 * y, levels: pixels.slice(first, first + 3) });
    }
    return found;
}

/** Linear sRGB of the material there, clipped as the page does. */
async function exact(name, points) {
    const material = JSON.parse(readFileSync(scene, 'utf8')).materials.find((one) => one.name === name);
    const commands = points.map(({ cosine, t }) => ['color', material.stack, '-a', Math.acos(cosine) * 180 / Math.PI,
        ...Object.entries(material.vary ?? {}).flatMap(([path, [first, last]]) =>
            ['--set', `${path}=${first + t * (last - first)}`])]);
    return (await iridoEach(commands)).map((text) => {
        const [{ r, g, b }] = csv(text);
        return [r, g, b].map((v) => Math.min(Math.max(Number(v), 0), 1));
    });
}

/** The largest Delta E 2000 that the rounding of three channels to 8 bits makes. */
function rounding(rgb) {
    const lab = labFromSrgb(rgb);
    return Math.max(...[0, 1, 2, 3, 4, 5, 6, 7].map((corner) => deltaE2000(lab, labFromSrgb(rgb.map((value, c) =>
        decoded(Math.min(Math.max(encoded(value) + (corner >> c & 1 ? 0.5 : -0.5) / 255, 0), 1)))))));
}

describe(`spheres from manifest.json in ${version}`, () => {
    it('the page says nothing', () => assert.deepEqual(said.filter((line) => !/ReadPixels|color primaries/.test(line)), []));
    for (const [seed, name] of shown.entries())
        it(name, async (test) => {
            const points = places(name, seed + 1);
            const colors = await exact(name, points);
            const material = manifest.materials[name];
            // a series' table is absolute in XYZ: the scene's tolerance is what colours are held to
            const stated = material.shading === 'color'
                ? manifest.tables[material.tables.reflection].error.value : manifest.settings.tolerance.delta_e;
            let largest = 0;
            points.forEach(({ levels }, i) => {
                const seen = levels.map((level) => decoded(level / 255));
                const difference = deltaE2000(labFromSrgb(seen), labFromSrgb(colors[i])), bound = stated + rounding(colors[i]);
                largest = Math.max(largest, difference);
                assert.ok(difference <= bound, `${name}: Delta E ${difference} at cos ${points[i].cosine}, t ${points[i].t}: `
                    + `${levels}, not ${colors[i].map((v) => 255 * encoded(v))}, bound ${bound}`);
            });
            test.diagnostic(`${points.length} pixels, largest Delta E ${largest.toPrecision(2)}, stated ${stated.toPrecision(2)}`);
        });
});
