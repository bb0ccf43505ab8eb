// The page of irido view in headless Chromium: opened from disk, used with pointer and keys, its
// colours compared with those of irido color.
import assert from 'node:assert/strict';
import { statSync, writeFileSync } from 'node:fs';
import { after, before, describe, it } from 'node:test';
import { decode } from 'fast-png';
import { openPage } from './support/devtools.js';
import { csv, irido, run, temporaryFolder } from './support/irido.js';

const folder = temporaryFolder();
const bytesOf = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
const numbers = (text) => text.replaceAll('\u2212', '-').split(',').map(Number);

/** A page of a stack; its file's name. */
function pageOf(stack) {
    const file = `${folder}/page.html`;
    irido('view', stack, '-o', file);
    return file;
}

const shown = (page) => page.evaluate(`({ angle: parseFloat(document.getElementById('angle-shown').textContent),
    hex: document.getElementById('hex').textContent, lab: document.getElementById('lab').textContent,
    rgb: document.getElementById('rgb').textContent })`);

/** What irido color says of a stack document, at angles. */
function colorsOf(stack, angles) {
    const file = `${folder}/changed.json`;
    writeFileSync(file, JSON.stringify(stack));
    return csv(irido('color', file, '-a', angles.join(','), '--quiet'));
}

/** Waits until a change has been drawn. */
const settled = (page) => page.evaluate('new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))');

describe('the page of a film', () => {
    let page;
    before(async () => { page = await openPage(pageOf('air | 1.33@400 | 1.9+1.5i')); });
    after(() => page?.close());

    it('is small, asks for nothing and complains of nothing', async () => {
        assert.ok(statSync(`${folder}/page.html`).size < 2e6);
        await page.until('document.getElementById("hex").textContent !== ""');
        assert.deepEqual(page.messages.filter((text) => !text.startsWith('file://')), []);
    });

    it('shows the colours of irido color at 100 places of the sphere', async () => {
        await page.click('#environment');
        await page.evaluate('document.getElementById("environment").value = "2"; document.getElementById("environment").dispatchEvent(new Event("change"))');
        const box = await page.show('#picture');
        const seen = [];
        for (let i = 0; i < 100; ++i) {
            const r = 0.985 * Math.sqrt((i + 0.5) / 100), turn = 2.4 * i; // spread over the disc
            const x = Math.round(box.left + box.width / 2 * (1 + 0.9 * r * Math.cos(turn)));
            const y = Math.round(box.top + box.height / 2 * (1 + 0.9 * r * Math.sin(turn)));
            await page.move(x, y);
            seen.push({ x, y, ...await shown(page) });
        }
        const image = decode(await page.screenshot());
        const wanted = colorsOf(JSON.parse(irido('convert', 'air | 1.33@400 | 1.9+1.5i', '-o', '-')), seen.map(({ angle }) => angle));
        seen.forEach(({ x, y, hex, rgb, angle }, i) => {
            const color = wanted[i];
            bytesOf(hex).forEach((byte, c) => assert.ok(Math.abs(byte - bytesOf(color.hex)[c]) <= 1, `${hex} at ${angle}`));
            numbers(rgb).forEach((value, c) => assert.ok(Math.abs(value - color['rgb'[c]]) < 5e-4));
            const r = Math.hypot(x - box.left - box.width / 2, y - box.top - box.height / 2) / box.width * 2 / 0.9;
            if (r > 0.95) return; // a pixel there spans several degrees
            const at = (y * image.width + x) * image.channels;
            bytesOf(color.hex).forEach((byte, c) => assert.ok(Math.abs(image.data[at + c] - byte) <= 4,
                `${[...image.data.slice(at, at + 3)]} for ${color.hex} at ${angle}`));
        });
    });

    it('follows its sliders, moved by keys, pointer and typing, at 100 angles', async () => {
        const thickness = '#stack-sliders input[type=range]';
        await page.click(thickness, 0.7);
        for (let i = 0; i < 5; ++i) await page.key('ArrowRight', 39);
        await settled(page);
        const stack = await page.evaluate('changedDocument()');
        assert.notEqual(stack.layers[0].thickness_nm, 400);
        assert.equal(stack.layers[0].thickness_nm, await page.evaluate(`Number(document.querySelector('${thickness}').value)`));
        const box = await page.show('#strip'), seen = [];
        for (let i = 0; i < 100; ++i) {
            await page.move(box.left + (i + 0.5) / 100 * box.width, box.top + 20);
            seen.push(await shown(page));
        }
        const wanted = colorsOf(stack, seen.map(({ angle }) => angle));
        seen.forEach(({ hex, lab }, i) => {
            bytesOf(hex).forEach((byte, c) => assert.ok(Math.abs(byte - bytesOf(wanted[i].hex)[c]) <= 1));
            const white = [0.9504559270516716, 1, 1.0890577507598784];
            const f = ['X', 'Y', 'Z'].map((name, j) => wanted[i][name] / white[j])
                .map((t) => (t > (6 / 29) ** 3 ? Math.cbrt(t) : t / (3 * (6 / 29) ** 2) + 4 / 29));
            const expected = [116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])];
            numbers(lab).forEach((value, c) => assert.ok(Math.abs(value - expected[c]) < 0.1, `${lab} for ${expected}`));
        });
        const index = '#stack-sliders .slider:nth-child(2) input[type=number]';
        await page.click(index);
        await page.evaluate(`document.querySelector('${index}').select()`);
        await page.type('1.7');
        await settled(page);
        const changed = await page.evaluate('changedDocument()');
        assert.deepEqual(changed.layers[0].material, { n: 1.7 });
        const now = await shown(page), [color] = colorsOf(changed, [now.angle]);
        assert.equal(now.hex, color.hex);
    });

    /** Types a value into the number of the view slider whose label begins so, and leaves it. */
    async function setView(label, value) {
        const place = `[...document.querySelectorAll('#view-sliders .slider')].find((row) => row.textContent.startsWith('${label}'))`;
        await page.evaluate(`${place}.querySelector('input[type=number]').id = 'typed-now'`);
        await page.click('#typed-now');
        await page.evaluate(`document.getElementById('typed-now').select()`);
        await page.type(String(value));
        await page.evaluate(`document.getElementById('typed-now').blur(); document.getElementById('typed-now').id = ''`);
        await settled(page);
    }

    it('lets the layer vary, with the thickness and the colour at the pointer', async () => {
        await page.click('#reset');
        await page.evaluate('document.getElementById("environment").value = "2"; draw()');
        await setView('layer 1 of sphere', 60);
        await setView('scale', 2);
        const box = await page.show('#picture'), seen = [];
        for (let i = 0; i < 30; ++i) {
            const r = 0.8 * Math.sqrt((i + 0.5) / 30), turn = 2.4 * i;
            const x = Math.round(box.left + box.width / 2 * (1 + 0.9 * r * Math.cos(turn)));
            const y = Math.round(box.top + box.height / 2 * (1 + 0.9 * r * Math.sin(turn)));
            await page.move(x, y);
            seen.push({ x, y, ...await shown(page), nm: await page.evaluate('parseFloat(document.getElementById("thickness-shown").textContent)') });
        }
        assert.ok(new Set(seen.map(({ nm }) => nm)).size > 20);
        const image = decode(await page.screenshot()), stack = JSON.parse(irido('convert', 'air | 1.33@400 | 1.9+1.5i', '-o', '-'));
        for (const { x, y, nm, angle, hex } of seen) {
            assert.ok(nm >= 340 && nm <= 460);
            stack.layers[0].thickness_nm = nm;
            const [color] = colorsOf(stack, [angle]), at = (y * image.width + x) * image.channels;
            bytesOf(hex).forEach((byte, c) => assert.ok(Math.abs(byte - bytesOf(color.hex)[c]) <= 2, `${hex} for ${color.hex}`));
            bytesOf(color.hex).forEach((byte, c) => assert.ok(Math.abs(image.data[at + c] - byte) <= 6,
                `${[...image.data.slice(at, at + 3)]} for ${color.hex} at ${angle}, ${nm} nm`));
        }
        await setView('layer 1 of sphere', 0);
    });

    it('is rough by its slider: in white surroundings the albedo of irido brdf', async () => {
        await setView('roughness', 0.2);
        const box = await page.show('#picture'), image = decode(await page.screenshot());
        const [color] = csv(irido('brdf', 'air | 1.33@400 | 1.9+1.5i', '--alpha', '0.2', '--quantity', 'albedo', '--color', '--light-theta', '0'));
        const at = (Math.round(box.top + box.height / 2) * image.width + Math.round(box.left + box.width / 2)) * image.channels;
        bytesOf(color.hex).forEach((byte, c) => assert.ok(Math.abs(image.data[at + c] - byte) <= 4,
            `${[...image.data.slice(at, at + 3)]} for ${color.hex}`));
        await setView('roughness', 0);
    });

    it('turns its surroundings by dragging and by keys', async () => {
        await page.evaluate('document.getElementById("environment").value = "0"; draw()');
        const box = await page.show('#picture'), middle = [box.left + box.width / 2, box.top + box.height / 2];
        const before = await page.screenshot();
        await page.drag(middle, [middle[0] + 90, middle[1] + 20]);
        const dragged = await page.screenshot();
        assert.notDeepEqual(dragged, before);
        await page.evaluate('document.getElementById("picture").focus()');
        await page.key('ArrowLeft', 37);
        assert.notDeepEqual(await page.screenshot(), dragged);
    });

    it('has a name for everything that can be used', async () => {
        assert.deepEqual(await page.evaluate(`[...document.querySelectorAll('input, select, button, canvas')]
            .filter((e) => !(e.labels?.length || e.getAttribute('aria-label') || e.getAttribute('aria-labelledby') || e.textContent.trim()))
            .map((e) => e.outerHTML)`), []);
    });
});

describe('the page of a mirror', () => {
    it('fits a telephone, shows a bubble and agrees with irido color', async () => {
        const stack = '1 | (1@125 | 1.5@375)^8 | 1';
        const page = await openPage(pageOf(stack), { width: 390, height: 844 });
        try {
            await page.until('document.getElementById("hex").textContent !== ""');
            assert.ok(await page.evaluate('document.documentElement.scrollWidth <= innerWidth'));
            await page.click('input[value=bubble]');
            await settled(page);
            // what does not absorb is white in white surroundings, seen through both walls
            await page.evaluate('document.getElementById("environment").value = "2"; draw()');
            const box = await page.show('#picture'), image = decode(await page.screenshot());
            for (let i = -8; i <= 8; ++i) {
                const x = Math.round(box.left + box.width / 2 * (1 + 0.1 * i)), y = Math.round(box.top + box.height / 2);
                const at = (y * image.width + x) * image.channels;
                for (let c = 0; c < 3; ++c) assert.ok(image.data[at + c] >= 253, `${[...image.data.slice(at, at + 3)]}`);
            }
            const angles = [0, 20, 40, 60], error = await page.evaluate('data.error.given');
            assert.ok(error < 0.5);
            const rgb = await page.evaluate(`[${angles}].map((angle) => answerAt(angle).rgb)`);
            colorsOf(JSON.parse(irido('convert', stack, '-o', '-')), angles).forEach((row, i) =>
                ['r', 'g', 'b'].forEach((name, c) => assert.ok(Math.abs(rgb[i][c] - row[name]) < 2e-3)));
        } finally {
            await page.close();
        }
    });
});

describe('where there is no WebGL 2', () => {
    it('the page says so and shows the strip', async () => {
        const page = await openPage(pageOf('air | 1.33@400 | air'), { flags: ['--disable-gpu', '--disable-3d-apis', '--disable-software-rasterizer'] });
        try {
            await page.until('document.getElementById("hex").textContent !== ""');
            assert.match(await page.evaluate('document.getElementById("message").textContent'), /cannot draw with WebGL 2/);
            assert.ok(await page.evaluate('!document.getElementById("message").hidden && document.getElementById("picture").hidden'));
            const colors = await page.evaluate(`new Set(document.getElementById('strip').getContext('2d')
                .getImageData(0, 0, document.getElementById('strip').width, 1).data).size`);
            assert.ok(colors > 20);
        } finally {
            await page.close();
        }
    });
});

describe('stacks that no page can show', () => {
    for (const [stack, reason] of [['air | BK7@1mm! | air', /an incoherent layer cannot be shown/]])
        it(stack, () => {
            const { status, stderr } = run('view', stack, '-o', `${folder}/x.html`);
            assert.equal(status, 2);
            assert.match(stderr, reason);
        });
});
