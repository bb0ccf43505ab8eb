// The job array of docs/sweeps.md under Slurm and its line for GNU Parallel, with shards that are killed.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync, readdirSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { dirname } from 'node:path';
import { after, before, describe, it } from 'node:test';
import { startCluster, until } from './support/cluster.js';
import { program, temporaryFolder } from './support/irido.js';
import { pageBlock } from './support/pages.js';

// no quick film: each shard takes some seconds
const layers = Array.from({ length: 30 }, (_, i) => ({ material: i % 2 ? 'TiO2' : 'SiO2', thickness_nm: 60 + 7 * i }));
const stack = JSON.stringify({ incident: 'air', layers, substrate: 'Si' });

const folder = temporaryFolder();
symlinkSync(program, `${folder}/irido`);
process.env.PATH = `${folder}:${process.env.PATH}`;

/** Runs a command of the page in a folder of its own that has stack.json. */
function shell(command, cwd) {
    const result = spawnSync('sh', ['-c', command], { cwd, encoding: 'utf8' });
    assert.equal(result.status, 0, result.stderr);
    return result;
}

function newFolder() {
    const place = temporaryFolder();
    writeFileSync(`${place}/stack.json`, stack);
    return place;
}

/** The sweep of the page's commands by one process. */
function wholeSweep(job) {
    const place = newFolder();
    const sweep = job.replace(/\\\n/g, ' ').match(/^.*?(irido sweep.*?) --shard/m)[1];
    shell(`${sweep} -o sweep.csv`, place);
    return readFileSync(`${place}/sweep.csv`);
}

/** Kills with -9 the process that writes a part, once that has rows. */
async function killWriterOf(part, seconds) {
    await until(() => existsSync(part) && readFileSync(part).length > 0, seconds, part);
    const writers = readdirSync('/proc').filter((id) => /^\d+$/.test(id)).filter((id) => {
        try {
            return readdirSync(`/proc/${id}/fd`).length > 0 &&
                readFileSync(`/proc/${id}/cmdline`, 'utf8').split('\0')[0].endsWith('irido') &&
                readFileSync(`/proc/${id}/cmdline`, 'utf8').includes(part.replace(/^.*\/|\.part$/g, ''));
        } catch {
            return false;
        }
    });
    assert.equal(writers.length, 1);
    process.kill(Number(writers[0]), 'SIGKILL');
}

describe('a sweep in shards', () => {
    const job = pageBlock('sh', '#SBATCH');
    let whole, cluster;
    before(async () => {
        whole = wholeSweep(job);
        cluster = await startCluster(temporaryFolder());
    });
    after(() => cluster.stop());

    it('runs as a job array of Slurm; shards that are killed and requeued change nothing', async () => {
        const place = newFolder();
        writeFileSync(`${place}/sweep.sh`, job);
        const id = cluster.run('sbatch', '--parsable', `--chdir=${place}`, `${place}/sweep.sh`).trim();
        // one loses its process, the other one is taken off its node
        await killWriterOf(`${place}/part-1.csv.part`, 60);
        await until(() => existsSync(`${place}/part-2.csv.part`), 60, 'a second shard');
        cluster.run('scontrol', 'requeue', `${id}_2`);
        await until(() => cluster.run('squeue', '-h', '-t', 'all', '-o', '%i %T').split('\n')
            .some((line) => /^\d+_1 (FAILED|COMPLETED|CANCELLED)/.test(line)), 60, 'the end of the first');
        assert.match(cluster.run('squeue', '-h', '-t', 'all', '-o', '%i %T'), /_1 FAILED/);
        cluster.run('scontrol', 'requeue', `${id}_1`);
        await until(() => cluster.run('squeue', '-h', '-t', 'pending,running,completing,requeued')
            .trim() === '', 180, 'the end of all');
        assert.ok(!existsSync(`${place}/sweep.csv`));
        shell(pageBlock('sh', 'irido sweep --merge part-*.csv'), place);
        assert.ok(whole.equals(readFileSync(`${place}/sweep.csv`)));
    });

    it('runs under GNU Parallel, which tries a shard that is killed again', async () => {
        const place = newFolder();
        const command = pageBlock('sh', 'parallel ');
        const { spawn } = await import('node:child_process');
        const running = spawn('sh', ['-c', command], { cwd: place, stdio: 'ignore' });
        const ended = new Promise((resolve) => { running.on('exit', resolve); });
        await killWriterOf(`${place}/part-1.csv.part`, 60);
        assert.equal(await ended, 0);
        shell(pageBlock('sh', 'irido sweep --merge part-*.csv'), place);
        assert.ok(whole.equals(readFileSync(`${place}/sweep.csv`)));
    });
});
