// Pictures read by other programs: PNG by fast-png, PDF by Poppler; their pixels and words are where
// the rows of numbers say.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { describe, it } from 'node:test';
import { decode } from 'fast-png';
import { irido, temporaryFolder } from './support/irido.js';

const folder = temporaryFolder();
const scale = 2; // pixels a unit of PNG, and of PDF at 192 dpi

/** Rows of a CSV, objects by the header's names. */
function rowsOf(csv) {
    const [header, ...lines] = csv.trimEnd().split('\n').map((line) => line.split(','));
    return lines.map((line) => Object.fromEntries(header.map((name, i) => [name, line[i]])));
}

/** The frames of an SVG's panels. */
function framesOf(svg) {
    const boxes = svg.matchAll(/class="frame">\n<rect x="(.*?)" y="(.*?)" width="(.*?)" height="(.*?)"/g);
    return [...boxes].map((match) => {
        const [left, top, width, height] = match.slice(1).map(Number);
        return { left, top, width, height };
    });
}

/** The pixel at a place of a frame: parts of its width and of its height from the top. */
function pixelAt(image, frame, x, y) {
    const column = Math.floor(scale * (frame.left + x * frame.width));
    const row = Math.floor(scale * (frame.top + y * frame.height));
    const at = (row * image.width + column) * image.channels;
    return [...image.data.slice(at, at + 3)];
}

const bytesOf = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));

function readPng(...args) {
    const file = `${folder}/x.png`;
    irido(...args, '--quiet', '-o', file);
    return decode(readFileSync(file));
}

/** The page of a PDF as pixels. */
function readPdf(...args) {
    const file = `${folder}/x.pdf`;
    irido(...args, '--quiet', '-o', file);
    const ppm = execFileSync('pdftoppm', ['-r', '192', '-singlefile', '-aa', 'no', file],
        { maxBuffer: 2 ** 26 });
    const head = /^P6\n(\d+) (\d+)\n255\n/.exec(ppm.toString('latin1', 0, 40));
    return { width: Number(head[1]), height: Number(head[2]), channels: 3, data: ppm.subarray(head[0].length) };
}

const svgOf = (...args) => irido(...args, '--quiet', '-f', 'svg');

function near(actual, expected, tolerance) {
    actual.forEach((value, i) => assert.ok(Math.abs(value - expected[i]) <= tolerance,
        `${actual} is not ${expected}`));
}

describe('a strip of colours', () => {
    const command = ['color', 'air | TiO2@180 | Ti', '-a', '0:80:10', '--side', 'R,T'];
    const rows = rowsOf(irido(...command, '--quiet'));
    const [frame] = framesOf(svgOf(...command));
    const check = (image, unit) => rows.forEach((row) => {
        const x = (row.angle_deg / 10 + 0.5) / 9, y = row.side === 'R' ? 0.25 : 0.75;
        near(pixelAt(image, frame, x, y).map((value) => value / unit), bytesOf(row.hex), 0.51);
    });

    it('has the colours of the rows in PNG of 8 bits', () => check(readPng(...command), 1));
    it('has them in PNG of 16 bits', () => {
        const image = readPng(...command, '--bits', '16');
        assert.equal(image.depth, 16);
        check(image, 257);
    });
    it('has them in PDF', () => check(readPdf(...command), 1));
});

describe('a map of colours', () => {
    it('shows a table in sRGB', () => {
        const table = ['lut', 'color', 'air | 1.33@400 | 1.9+1.5i', '--cos', '0:1/5', '--vary',
            'layers.0.thickness_nm=0:1000/9'];
        const encode = (c) => 255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055);
        const [frame] = framesOf(svgOf(...table)), image = readPng(...table);
        for (const row of rowsOf(irido(...table, '--quiet'))) {
            const x = (row['layers.0.thickness_nm'] / 125 + 0.5) / 9;
            const y = 1 - (row.cos_theta * 4 + 0.5) / 5;
            const rgb = [row.R, row.G, row.B].map((c) => encode(Math.min(1, Math.max(0, Number(c)))));
            near(pixelAt(image, frame, x, y), rgb, 0.51);
        }
    });
});

describe('a heat map', () => {
    it('is the lighter the larger the value', () => {
        const command = ['spectrum', 'air | SiO2@300 | Si', '-w', '400:700:10', '-a', '0:80:5', '-p', 's'];
        const [frame] = framesOf(svgOf(...command)), image = readPng(...command);
        const light = ([r, g, b]) => 0.2126 * (r / 255) ** 2.2 + 0.7152 * (g / 255) ** 2.2 + 0.0722 * (b / 255) ** 2.2;
        const cells = rowsOf(irido(...command)).map((row) => ({
            value: Number(row.R),
            light: light(pixelAt(image, frame, ((row.wavelength_nm - 400) / 10 + 0.5) / 31,
                1 - (row.angle_deg / 5 + 0.5) / 17)),
        })).sort((a, b) => a.value - b.value);
        const step = 40;
        for (let i = step; i < cells.length; ++i)
            if (cells[i].value > cells[i - step].value + 0.02)
                assert.ok(cells[i].light > cells[i - step].light, `cell ${i}`);
    });
});

describe('a curve', () => {
    it('passes where the numbers are', () => {
        const command = ['spectrum', 'air | SiO2@300 | Si', '-w', '400:800:1'];
        const svg = svgOf(...command), [frame] = framesOf(svg), image = readPng(...command);
        const labels = [...svg.matchAll(/y="([\d.]+)" text-anchor="end" fill="#222222">([\d.]+)</g)]
            .map((match) => [Number(match[2]), Number(match[1]) - 4])
            .filter(([, y]) => y <= frame.top + frame.height);
        const [[v0, y0], [v1, y1]] = [labels[0], labels.at(-1)];
        for (const row of rowsOf(irido(...command, '--quiet'))) {
            if (row.wavelength_nm % 25 !== 0 || row.wavelength_nm % 400 === 0) continue;
            const y = y0 + (row.R - v0) / (v1 - v0) * (y1 - y0);
            const pixel = pixelAt(image, frame, (row.wavelength_nm - 400) / 400, (y - frame.top) / frame.height);
            near(pixel, bytesOf('#0072b2'), 2);
        }
    });
});

describe('PDF', () => {
    it('has text that is found and copied', () => {
        irido('spectrum', 'air | MgF2@100 | BK7', '-a', '0,45', '-p', 's,p', '--quiet', '--set',
            'name="λ/4 − Ωя 漢 <&>"', '-o', `${folder}/text.pdf`);
        const text = execFileSync('pdftotext', [`${folder}/text.pdf`, '-'], { encoding: 'utf8' });
        for (const words of ['λ/4 − Ωя 漢 <&>', 's, 45°', 'reflectance R', 'vacuum wavelength, nm', 'A is 0 throughout'])
            assert.ok(text.includes(words), words);
        const info = execFileSync('pdfinfo', [`${folder}/text.pdf`], { encoding: 'utf8' });
        assert.match(info, /Title: +λ\/4/);
        assert.match(info, /Pages: +1/);
    });
});
