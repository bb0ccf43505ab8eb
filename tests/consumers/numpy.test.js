// .npy files read by NumPy; raw files by nothing but JavaScript; checksums by other programs.
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { describe, it } from 'node:test';
import { csvValues, irido, readBin, temporaryFolder } from './support/irido.js';

const folder = temporaryFolder();
const film = ['air | 1.33@400 | 1.9+1.5i', '--cos', '0:1/8'];
const thickness = ['--vary', 'layers.0.thickness_nm=0:1000/16'];
const requests = {
    cumulative: ['cumulative', '-w', '380:780:10'],
    'sensitivity with spreads': ['sensitivity', '--opd', '0:4000/64', '--sigma', '0,50'],
    'color over the angle': ['color', ...film],
    color: ['color', ...film, ...thickness],
    'color with two values': ['color', ...film, ...thickness, '--vary', 'layers.0.material=1.2:1.8/4'],
};

const script = `
import hashlib, json, sys
import numpy
answers = []
for name in json.load(sys.stdin):
    a = numpy.load(name + ".npy")
    answers.append({"dtype": a.dtype.str, "shape": a.shape, "order": bool(a.flags.c_contiguous),
                    "values": a.astype(numpy.float64).ravel().tolist(),
                    "checksum": "sha256:" + hashlib.sha256(open(name + ".bin", "rb").read()).hexdigest()})
json.dump(answers, sys.stdout)
`;

const names = [];
for (const [i, request] of Object.values(requests).entries())
    for (const type of ['f16', 'f32', 'f64']) {
        const name = `${folder}/${i}-${type}`;
        for (const format of ['npy', 'bin'])
            irido('lut', ...request, '--dtype', type, '-o', `${name}.${format}`);
        names.push({ name, type, request, title: `${Object.keys(requests)[i]}, ${type}` });
    }
// Debian's: another python3 may be first in the path, without NumPy
const answers = JSON.parse(execFileSync('/usr/bin/python3', ['-c', script], {
    input: JSON.stringify(names.map(({ name }) => name)), encoding: 'utf8', maxBuffer: 1 << 28,
}));

describe('NumPy and plain JavaScript read', () => {
    names.forEach(({ name, type, request, title }, i) => it(title, () => {
        const answer = answers[i];
        const table = readBin(`${name}.bin`);
        const { metadata } = table;
        const counts = metadata.axes.map((axis) => axis.count);
        const expected = csvValues(irido('lut', ...request, '--dtype', type), counts.length);
        assert.equal(answer.dtype, { f16: '<f2', f32: '<f4', f64: '<f8' }[type]);
        assert.deepEqual(answer.shape, [...counts, metadata.channels.length]);
        assert.ok(answer.order);
        assert.deepEqual(answer.values, expected);
        assert.deepEqual([...table.values], expected);
        assert.equal(answer.checksum, metadata.checksum);
        assert.equal('sha256:' + createHash('sha256').update(table.bytes).digest('hex'), metadata.checksum);
        assert.deepEqual(JSON.parse(readFileSync(`${name}.npy.json`, 'utf8')), metadata);
        assert.deepEqual(JSON.parse(irido('lut', 'info', `${name}.npy`)), metadata);
    }));
});
