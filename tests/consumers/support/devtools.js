// A page in headless Chromium, driven as a person would: pointer, keys and eyes (screenshots), by the
// DevTools protocol over a pipe.
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { setTimeout as sleep } from 'node:timers/promises';

/** Opens a file's page of that size; `flags` are further ones of Chromium. */
export async function openPage(file, { width = 1200, height = 900, flags = [] } = {}) {
    const profile = mkdtempSync(join(tmpdir(), 'irido-chromium-'));
    const browser = spawn('chromium', ['--headless=new', '--no-sandbox', '--use-angle=swiftshader',
        '--enable-unsafe-swiftshader', '--disable-dev-shm-usage', '--no-first-run', '--disable-extensions',
        '--disable-background-networking', '--disable-sync', '--disable-component-update', '--hide-scrollbars',
        '--force-device-scale-factor=1', `--user-data-dir=${profile}`, '--remote-debugging-pipe', ...flags, 'about:blank'],
    { detached: true, stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'], env: { ...process.env, TMPDIR: profile } });
    const waiting = new Map(), messages = [];
    let last = 0, rest = '', session;
    browser.stdio[4].on('data', (bytes) => {
        const parts = (rest + bytes).split('\0');
        rest = parts.pop();
        for (const message of parts.map((part) => JSON.parse(part))) {
            if (message.method === 'Runtime.exceptionThrown') messages.push(message.params.exceptionDetails.text);
            if (message.method === 'Log.entryAdded') messages.push(message.params.entry.text);
            if (message.method === 'Network.requestWillBeSent') messages.push(message.params.request.url);
            const answer = waiting.get(message.id);
            waiting.delete(message.id);
            if (message.error) answer?.reject(new Error(message.error.message));
            else answer?.resolve(message.result);
        }
    });
    const send = (method, params = {}) => new Promise((resolve, reject) => {
        waiting.set(++last, { resolve, reject });
        browser.stdio[3].write(`${JSON.stringify({ id: last, method, params, sessionId: session })}\0`);
    });
    const kill = () => {
        try {
            process.kill(-browser.pid, 'SIGKILL');
        } catch { /* it is gone */ }
        rmSync(profile, { recursive: true, force: true, maxRetries: 10, retryDelay: 100 });
    };
    process.on('exit', kill);
    const isGone = new Promise((resolve) => browser.once('exit', resolve));
    browser.on('exit', () => waiting.forEach(({ reject }) => reject(new Error('chromium has ended'))));

    const { targetId } = await send('Target.createTarget', { url: 'about:blank' });
    ({ sessionId: session } = await send('Target.attachToTarget', { targetId, flatten: true }));
    for (const domain of ['Page', 'Runtime', 'Log', 'Network']) await send(`${domain}.enable`);
    await send('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: 1, mobile: false });
    await send('Page.navigate', { url: `file://${file}` });

    const evaluate = async (expression) => {
        const { result, exceptionDetails } = await send('Runtime.evaluate',
            { expression, returnByValue: true, awaitPromise: true });
        if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
        return result.value;
    };
    const mouse = (type, x, y, more = {}) => send('Input.dispatchMouseEvent', { type, x, y, ...more });
    const page = {
        evaluate,
        /** What the page has complained of, and what it has asked the network for. */
        messages,
        /** Until an expression is true. */
        async until(expression, seconds = 30) {
            for (let i = 0; i < 20 * seconds; ++i, await sleep(50)) if (await evaluate(expression)) return;
            throw new Error(`not in ${seconds} s: ${expression}`);
        },
        /** The box of an element in the window. */
        box: (selector) => evaluate(`(() => { const b = document.querySelector(${JSON.stringify(selector)})
            .getBoundingClientRect(); return { left: b.left, top: b.top, width: b.width, height: b.height }; })()`),
        async show(selector) {
            await evaluate(`document.querySelector(${JSON.stringify(selector)}).scrollIntoView({ block: 'center' })`);
            return page.box(selector);
        },
        move: (x, y) => mouse('mouseMoved', x, y),
        async click(selector, part = 0.5) {
            const box = await page.show(selector), x = box.left + part * box.width, y = box.top + box.height / 2;
            await mouse('mouseMoved', x, y);
            await mouse('mousePressed', x, y, { button: 'left', buttons: 1, clickCount: 1 });
            await mouse('mouseReleased', x, y, { button: 'left', clickCount: 1 });
        },
        async drag(from, to) {
            await mouse('mouseMoved', ...from);
            await mouse('mousePressed', ...from, { button: 'left', buttons: 1, clickCount: 1 });
            await mouse('mouseMoved', ...to, { button: 'left', buttons: 1 });
            await mouse('mouseReleased', ...to, { button: 'left', clickCount: 1 });
        },
        async key(key, code) {
            await send('Input.dispatchKeyEvent', { type: 'keyDown', key, windowsVirtualKeyCode: code });
            await send('Input.dispatchKeyEvent', { type: 'keyUp', key, windowsVirtualKeyCode: code });
        },
        type: (text) => send('Input.insertText', { text }),
        async screenshot() {
            return Buffer.from((await send('Page.captureScreenshot', { format: 'png' })).data, 'base64');
        },
        async close() {
            kill();
            await isGone;
            process.off('exit', kill);
            rmSync(profile, { recursive: true, force: true, maxRetries: 10, retryDelay: 100 });
        },
    };
    await page.until('document.readyState === "complete"');
    return page;
}
