// Rendered pictures read by other programs: PNG by fast-png, OpenEXR by oiiotool; and environments
// that oiiotool writes.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { describe, it } from 'node:test';
import { decode } from 'fast-png';
import { csv, irido, run, temporaryFolder } from './support/irido.js';

const folder = temporaryFolder();
const film = 'air | 1.38@420 | 1.9+1.5i';

/** The hex colour of the stack where a pixel of a 256 x 256 sphere lies; none beside it. */
function colorAt(x, y) {
    const r = Math.hypot(x + 0.5 - 128, y + 0.5 - 128) / (0.9 * 128);
    if (r >= 1) return undefined;
    const angle = Math.asin(r) * 180 / Math.PI;
    return csv(irido('color', film, '-a', angle, '--quiet'))[0].hex;
}

const oiiotool = (...args) => execFileSync('oiiotool', args, { encoding: 'utf8', stdio: 'pipe' });

describe('a sphere in white surroundings', () => {
    for (const bits of [8, 16])
        it(`has the colours of irido color in PNG of ${bits} bits`, () => {
            const file = `${folder}/sphere.png`;
            irido('render', film, '--environment', 'white', '--size', '256', '--bits', bits, '-o', file);
            const image = decode(readFileSync(file));
            assert.deepEqual([image.width, image.height, image.channels, image.depth], [256, 256, 4, bits]);
            for (let i = 0; i < 60; ++i) {
                const x = (i * 37 + 11) % 256, y = (i * 101 + 5) % 256;
                const pixel = [...image.data.slice((y * 256 + x) * 4, (y * 256 + x) * 4 + 4)]
                    .map((value) => (bits === 16 ? value / 257 : value));
                const hex = colorAt(x, y);
                assert.equal(pixel[3], hex ? 255 : 0);
                if (hex) [1, 3, 5].forEach((at, c) =>
                    assert.ok(Math.abs(pixel[c] - parseInt(hex.slice(at, at + 2), 16)) <= 0.52, `${x}, ${y}`));
            }
        });
    it('is an OpenEXR picture with alpha for oiiotool', () => {
        const file = `${folder}/sphere.exr`;
        irido('render', film, '--environment', 'white', '--size', '64,48', '-o', file);
        const words = oiiotool('-v', '--info', '--stats', file);
        assert.match(words, /64 x\s+48, 4 channel, float openexr/);
        assert.match(words, /channel list: R, G, B, A/);
        assert.match(words, /chromaticities: 0\.64, 0\.33, 0\.3, 0\.6, 0\.15, 0\.06, 0\.31/);
        assert.match(words, /irido\.metadata/);
        assert.match(words, /Stats NanCount: 0 0 0 0/);
    });
});

describe('environments written by oiiotool', () => {
    const size = ['--size', '33', '--shape', 'plane', '-o', `${folder}/lit.exr`];
    const middle = () => oiiotool(`${folder}/lit.exr`, '--cut', '1x1+16+16', '--printstats')
        .match(/Stats Avg: (\S+) (\S+) (\S+)/).slice(1).map(Number);
    const mirror = 'air | 1.5@0 | 0.0001+30i';
    for (const [name, ...options] of [
        ['half with PIZ', '-d', 'half', '--compression', 'piz'],
        ['float in tiles with ZIP', '-d', 'float', '--compression', 'zip', '--tile', '32', '32'],
        ['half in tiles with RLE', '-d', 'half', '--compression', 'rle', '--tile', '16', '16'],
        ['half with B44A', '-d', 'half', '--compression', 'b44a'],
    ])
        it(name, () => {
            // the plane mirrors what is behind the camera: the left and right end of the picture
            oiiotool('--pattern', 'constant:color=0.5,2,4', '128x64', '3', ...options, '-o', `${folder}/light.exr`);
            irido('render', mirror, '--environment', `${folder}/light.exr`, ...size);
            middle().forEach((value, c) => assert.ok(Math.abs(value / [0.5, 2, 4][c] - 1) < 0.01, value));
        });
    it('with DWA compression are refused by name', () => {
        oiiotool('--pattern', 'constant:color=0.5,2,4', '64x32', '3', '-d', 'half', '--compression', 'dwaa', '-o', `${folder}/dwaa.exr`);
        const { status, stderr } = run('render', film, '--environment', `${folder}/dwaa.exr`, '-o', `${folder}/no.png`);
        assert.equal(status, 2);
        assert.match(stderr, /^irido: error: .*dwaa\.exr: this OpenEXR file is compressed by DWA, which cannot be read.*\n$/);
    });
});
