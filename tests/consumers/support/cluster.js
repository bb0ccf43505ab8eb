// A Slurm cluster of one node, this machine, in a folder of its own.
import { execFileSync, spawn } from 'node:child_process';
import { randomBytes } from 'node:crypto';
import { mkdirSync, writeFileSync } from 'node:fs';
import { availableParallelism, hostname } from 'node:os';
import { setTimeout as sleep } from 'node:timers/promises';

const node = hostname().split('.')[0];

const configuration = (folder) => `
ClusterName=irido
SlurmctldHost=${node}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthInfo=socket=${folder}/munge.socket,cred_expire=5
SlurmctldPort=26817
SlurmdPort=26818
StateSaveLocation=${folder}/state
SlurmdSpoolDir=${folder}/spool
SlurmctldPidFile=${folder}/slurmctld.pid
SlurmdPidFile=${folder}/slurmd.pid
SlurmctldLogFile=${folder}/slurmctld.log
SlurmdLogFile=${folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
MpiDefault=none
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0
KillWait=2
NodeName=${node} NodeAddr=127.0.0.1 CPUs=${availableParallelism()} State=UNKNOWN
PartitionName=all Nodes=${node} Default=YES MaxTime=INFINITE State=UP
`;

/** Calls `probe` until it answers something true; throws after so many seconds. */
export async function until(probe, seconds, what) {
    for (let tries = 0; tries < 20 * seconds; ++tries) {
        const answer = await probe();
        if (answer) return answer;
        await sleep(50);
    }
    throw new Error(`${what} did not happen in ${seconds} s`);
}

/** Starts it; the result has run(command, ...arguments) and stop(). */
export async function startCluster(folder) {
    for (const name of ['state', 'spool']) mkdirSync(`${folder}/${name}`, { recursive: true });
    writeFileSync(`${folder}/slurm.conf`, configuration(folder));
    writeFileSync(`${folder}/munge.key`, randomBytes(1024), { mode: 0o600 });
    const daemons = [];
    const start = (command, ...args) => {
        daemons.push(spawn(command, args, { stdio: 'ignore', cwd: folder }));
        process.on('exit', () => daemons.forEach((daemon) => daemon.kill('SIGKILL')));
    };
    const environment = { ...process.env, SLURM_CONF: `${folder}/slurm.conf` };
    const run = (command, ...args) =>
        execFileSync(command, args, { encoding: 'utf8', stdio: 'pipe', env: environment, cwd: folder });
    const succeeds = (...args) => {
        try {
            return run(...args);
        } catch {
            return '';
        }
    };
    start('munged', '--foreground', '--force', `--key-file=${folder}/munge.key`,
        `--socket=${folder}/munge.socket`, `--pid-file=${folder}/munged.pid`,
        `--log-file=${folder}/munged.log`, `--seed-file=${folder}/munged.seed`);
    await until(() => succeeds('munge', '-n', '-S', `${folder}/munge.socket`), 20, 'munged');
    start('slurmctld', '-D', '-f', `${folder}/slurm.conf`);
    start('slurmd', '-D', '-f', `${folder}/slurm.conf`);
    await until(() => /idle/.test(succeeds('sinfo', '-h', '-o', '%T')), 60, 'an idle node');
    const stop = async () => {
        for (const daemon of daemons.reverse()) daemon.kill('SIGTERM');
        await until(() => daemons.every((d) => d.exitCode !== null || d.signalCode !== null), 20, 'the end');
    };
    return { run, stop };
}
