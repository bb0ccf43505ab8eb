// three.js in headless Chromium: its KTX2Loader loads what irido writes, and the snippets of GLSL run
// on it. Each file in browser/ makes jobs, with a check of what comes back; Chromium starts once.
import assert from 'node:assert/strict';
import { describe, it } from 'node:test';
import { runInBrowser } from './support/chromium.js';
import { kinds, temporaryFolder } from './support/irido.js';

const rooms = ['textures', 'color', 'cumulative', 'sensitivity', 'fourier', 'bragg', 'falpha-closed', 'kinds', 'scratch',
               'engines', 'layered', 'brdf'];
const folder = temporaryFolder();
const jobs = [], skipped = [];
for (const room of rooms) {
    const { makeJobs } = await import(`./browser/${room}.js`);
    for (const job of await makeJobs(folder))
        (job.kind && !kinds.has(job.kind) ? skipped : jobs).push({ room, ...job });
}
const { version, answers } = await runInBrowser(
    jobs.map(({ name, tables, source, result, points }) => ({ name, tables, source, result, points })), folder);

describe(`three.js in ${version}`, () => {
    jobs.forEach(({ room, name, check, mayWarn }, i) => it(`${room}: ${name}`, (test) => {
        const { error, said, values, found } = answers[i];
        assert.equal(error, undefined);
        if (!mayWarn) assert.deepEqual(said, []);
        const measured = check(values, found, said);
        if (measured !== undefined) test.diagnostic(`${room}: ${name}: ${measured}`);
    }));
    for (const { room, name, kind } of skipped)
        it(`${room}: ${name}`, { skip: `this irido has no table ${kind}` }, () => {});
});
