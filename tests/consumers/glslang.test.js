// Shader code compiled by glslangValidator: GLSL ES 3.00, desktop GLSL 3.30, and HLSL.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { describe, it } from 'node:test';
import { irido, temporaryFolder } from './support/irido.js';
import { calls, glslProgram, hlslProgram } from './support/shader-calls.js';

const folder = temporaryFolder();
const names = irido('lut', 'shader', '--help').match(/one of (.*)/)[1].match(/[\w-]+/g);

function compile(code, ...args) {
    const file = `${folder}/shader.frag`;
    writeFileSync(file, code);
    const { status, stdout, stderr, error } = spawnSync('glslangValidator', [...args, '-S', 'frag', file],
        { encoding: 'utf8' });
    assert.ifError(error);
    const said = (stdout + stderr).split('\n').filter((line) => line && !line.endsWith('shader.frag'));
    assert.deepEqual([status, ...said], [0], said.join('\n'));
}

/** Functions of a snippet that are meant to be called by others: not those for a part of the work. */
function functionsIn(source) {
    return [...source.matchAll(/^(?:float\d?|vec\d|void) (irido_\w+)\(/gm)].map((match) => match[1]);
}

describe('glslangValidator compiles', () => {
    it('all snippets that there are', () => assert.deepEqual([...names].sort(), Object.keys(calls).sort()));
    for (const name of names) {
        const glsl = irido('lut', 'shader', name), hlsl = irido('lut', 'shader', name, '--language', 'hlsl');
        it(`${name}, GLSL ES 3.00`, () => compile(glslProgram(name, glsl, '300 es')));
        it(`${name}, GLSL 3.30`, () => compile(glslProgram(name, glsl, '330 core')));
        it(`${name}, HLSL`, () =>
            compile(hlslProgram(name, hlsl), '-D', '-V', '-e', 'main', '-o', `${folder}/shader.spv`));
        it(`${name} has the same functions in both`, () =>
            assert.deepEqual(functionsIn(glsl), functionsIn(hlsl)));
    }
});
