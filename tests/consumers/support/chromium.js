// One start of headless Chromium: serves the page and the tables on the loopback interface, waits for
// the page's answers, and leaves nothing behind.
import { spawn } from 'node:child_process';
import { createReadStream, existsSync, mkdtempSync, rmSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = fileURLToPath(new URL('..', import.meta.url));
const types = { '.html': 'text/html', '.js': 'text/javascript', '.json': 'application/json' };

/** Runs the jobs of support/PAGE.js; tables are files in `folder`, with URLs /tables/NAME. */
export async function runInBrowser(jobs, folder, { seconds = 120, page = 'page', flags = [] } = {}) {
    let settle;
    const answered = new Promise((resolve, reject) => { settle = { resolve, reject }; });
    const server = createServer((request, response) => {
        const path = normalize(new URL(request.url, 'http://localhost').pathname);
        if (request.method === 'POST' && path === '/answers') {
            const parts = [];
            request.on('data', (part) => parts.push(part)).on('end', () => {
                response.end();
                settle.resolve(JSON.parse(Buffer.concat(parts).toString()));
            });
            return;
        }
        if (path === '/jobs') {
            response.setHeader('Content-Type', 'application/json');
            response.end(JSON.stringify(jobs));
            return;
        }
        const file = path.startsWith('/tables/') ? join(folder, path.slice('/tables/'.length)) : join(root, path);
        if (!existsSync(file)) {
            response.statusCode = 404;
            response.end();
            return;
        }
        response.setHeader('Content-Type', types[extname(file)] ?? 'application/octet-stream');
        createReadStream(file).pipe(response);
    });
    await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));

    const profile = mkdtempSync(join(tmpdir(), 'irido-chromium-'));
    // without its sandbox, which neither root nor a container has: it opens no page but ours
    const browser = spawn('chromium', ['--headless=new', '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
        '--disable-dev-shm-usage',
        '--no-first-run', '--disable-extensions', '--disable-background-networking', '--disable-sync',
        '--disable-component-update', `--user-data-dir=${profile}`,
        ...flags, `http://127.0.0.1:${server.address().port}/support/${page}.html`], {
        detached: true,
        stdio: ['ignore', 'ignore', 'pipe'],
        env: { ...process.env, TMPDIR: profile },
    });
    const end = () => {
        try {
            process.kill(-browser.pid, 'SIGKILL');
        } catch { /* it is gone */ }
        rmSync(profile, { recursive: true, force: true, maxRetries: 10, retryDelay: 100 });
    };
    process.on('exit', end);
    let words = '';
    browser.stderr.on('data', (text) => { words = (words + text).slice(-4000); });
    browser.on('error', (error) => settle.reject(new Error(`chromium does not start: ${error.message}`)));
    browser.on('exit', (code) => settle.reject(new Error(`chromium ended (${code}) without an answer:\n${words}`)));
    const timer = setTimeout(() =>
        settle.reject(new Error(`chromium did not answer in ${seconds} s:\n${words}`)), 1000 * seconds);
    try {
        return await answered;
    } finally {
        clearTimeout(timer);
        const isGone = new Promise((resolve) => browser.exitCode === null && browser.pid
            ? browser.once('exit', resolve) : resolve());
        try {
            process.kill(-browser.pid, 'SIGKILL');
        } catch { /* it is gone */ }
        await isGone;
        end();
        process.off('exit', end);
        server.closeAllConnections();
        server.close();
    }
}
