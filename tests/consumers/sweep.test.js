// The recipes of docs/sweeps.md: sweeps drawn by gnuplot, read by NumPy and by h5py, and all formats alike.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { readFileSync, symlinkSync } from 'node:fs';
import { describe, it } from 'node:test';
import { csv, irido, program, temporaryFolder } from './support/irido.js';
import { pageBlock } from './support/pages.js';

const folder = temporaryFolder();
symlinkSync(program, `${folder}/irido`);
process.env.PATH = `${folder}:${process.env.PATH}`;

function shell(command) {
    const result = spawnSync('sh', ['-c', command], { cwd: folder, encoding: 'utf8' });
    assert.equal(result.status, 0, result.stderr);
    return result.stdout;
}

// Debian's: another python3 may be first in the path, without NumPy
const python = (script) => execFileSync('/usr/bin/python3', ['-c', script], { cwd: folder, encoding: 'utf8' });

describe('the recipes of docs/sweeps.md', () => {
    const recipe = pageBlock('sh', 'gnuplot');
    const sweep = recipe.slice(0, recipe.indexOf(' -o bubble.csv'));

    it('gnuplot draws it', () => {
        shell(recipe);
        const picture = readFileSync(`${folder}/bubble.png`);
        assert.equal(picture.toString('latin1', 1, 4), 'PNG');
        assert.ok(picture.length > 10000);
    });

    it('NumPy and h5py read what the CSV says', () => {
        shell(`${sweep} -o bubble.csv`);
        const rows = csv(readFileSync(`${folder}/bubble.csv`, 'utf8'));
        const most = Math.max(...rows.map((row) => Number(row.Y)));
        for (const [format, words] of [['npy', 'np.load'], ['h5', 'h5py']]) {
            shell(`${sweep} -o bubble.${format}`);
            const answer = python(pageBlock('python', words)).trim();
            for (const name of Object.keys(rows[0])) assert.ok(answer.includes(`'${name}'`), answer);
            assert.equal(Number(answer.split(' ').pop()), most);
        }
    });
});

const script = `
import json, sys, numpy
name = sys.argv[1]
if name.endswith("npy"):
    a = numpy.load(name)
    columns = {n: a[n] for n in a.dtype.names}
else:
    import h5py
    f = h5py.File(name)["/"]
    columns = {n: f[n].asstr()[:] if f[n].dtype.kind == "S" else f[n][:] for n in f}
json.dump({n: v.tolist() for n, v in columns.items()}, sys.stdout)
`;

describe('every format of a sweep has the same rows', () => {
    const requests = {
        color: ['1 | 1.5@0 | Si', '--vary', 'substrate=Si,1.9+1.5i,{"n":2}', '--vary',
            'layers.0.thickness_nm=0:200:50', '--side', 'R,T', '--stats'],
        spectrum: ['1 | 1.5@0 | Si', '--vary', 'layers.0.thickness_nm=0:200:50', '-p', 's,u', '-w', '500:600:50'],
        bands: ['1 | (1@200 | 1.5@180)^10 | 1', '--vary', 'layers.0.repeat=2:5:1', '--gaps'],
        cm: ['1 | 1.5@0 | 1.9', '--vary', 'layers.0.material=1.3:1.9:0.1'],
    };
    for (const [command, request] of Object.entries(requests))
        for (const format of ['npy', 'h5'])
            it(`${command}, ${format}`, () => {
                const asked = ['sweep', ...request, '--compute', command];
                const rows = JSON.parse(irido(...asked, '-f', 'json'));
                irido(...asked, '-o', `${folder}/rows.${format}`);
                const columns = JSON.parse(execFileSync('/usr/bin/python3',
                    ['-c', script, `${folder}/rows.${format}`], { encoding: 'utf8' }));
                assert.deepEqual(Object.keys(columns), Object.keys(rows[0]));
                for (const [name, values] of Object.entries(columns))
                    assert.deepEqual(values, rows.map((row) => row[name]), name);
            });
});
