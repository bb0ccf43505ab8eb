// Manual pages read by man without a warning; completions asked for in bash, zsh and fish.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readdirSync, writeFileSync } from 'node:fs';
import { describe, it } from 'node:test';
import { irido, program, temporaryFolder } from './support/irido.js';

const folder = temporaryFolder();
const root = new URL('../..', import.meta.url).pathname;
const asked = ['irido spect', 'irido lut alb', 'irido color --met', 'irido color --space di',
    'irido color --space=di', 'irido color --method fourier-', 'irido spectrum --columns psi_deg,delta_d',
    'irido materials show N-BK', 'irido spectrum schemas/examples/soap-bubble.', 'irido bake x -o sche'];
const wanted = ['spectrum', 'albedo', '--method', 'display-p3', 'display-p3', 'fourier-constant',
    'psi_deg,delta_deg', 'N-BK7', 'schemas/examples/soap-bubble.json', 'schemas/'];

function shell(name, ...args) {
    const { status, stdout, stderr, error } = spawnSync(name, args,
        { encoding: 'utf8', cwd: root, env: { ...process.env, TERM: 'dumb', HOME: folder } });
    assert.ifError(error);
    assert.equal(status, 0, stderr);
    return stdout;
}

describe('man shows without a warning', () => {
    irido('manual', '-o', folder);
    for (const page of readdirSync(folder).filter((name) => name.endsWith('.1')))
        it(page, () => {
            const { status, stdout, stderr } = spawnSync('man',
                ['--warnings', '-E', 'UTF-8', '-l', `${folder}/${page}`], { encoding: 'utf8' });
            assert.deepEqual([status, stderr], [0, '']);
            for (const section of ['NAME', 'SYNOPSIS', 'OPTIONS', 'EXAMPLES'])
                assert.match(stdout, new RegExp(`^${section}$`, 'm'));
        });
    it('characters of examples as they are typed', () => {
        const { stdout } = spawnSync('man', ['-E', 'UTF-8', '-l', `${folder}/irido-convert.1`],
            { encoding: 'utf8', env: { ...process.env, MANWIDTH: '100' } });
        assert.ok(stdout.includes('irido convert "air | (TiO2@58.5 | SiO2@94.2)^10 | BK7@1mm! | air"'), stdout);
    });
});

describe('completions', () => {
    for (const name of ['bash', 'zsh', 'fish'])
        it(`${name} reads them without a word`, () => {
            writeFileSync(`${folder}/irido.${name}`, irido('completion', name));
            assert.equal(shell(name, '-n', `${folder}/irido.${name}`), '');
        });

    it('bash', () => {
        const lines = asked.map((line) => line.replace('=', ' = '));
        const out = shell('bash', '-c', `source <("${program}" completion bash)
            while read -r -a COMP_WORDS; do COMP_CWORD=$((\${#COMP_WORDS[@]} - 1)); _irido
            echo "\${COMPREPLY[*]}"; done <<'END'\n${lines.join('\n')}\nEND`);
        assert.deepEqual(out.trimEnd().split('\n'), wanted.map((word) => word.replace(/\/$/, '')));
    });

    it('fish', () => {
        const out = shell('fish', '-N', '-c', `source ${folder}/irido.fish
            for line in ${asked.map((line) => `'${line}'`).join(' ')}
                complete -C $line | string replace -r '\\t.*' '' | string replace -r '^--space=' ''; or true
            end`);
        assert.deepEqual(out.trimEnd().split('\n'), wanted);
    });

    it('zsh', () => {
        const script = `zmodload zsh/zpty
            zpty terminal zsh -f -i
            zpty -w terminal 'PS1= ; unsetopt zle_bracketed_paste 2>/dev/null; autoload -Uz compinit'
            zpty -w terminal 'compinit -u -D; source ${folder}/irido.zsh; bindkey "^I" complete-word'
            zpty -w terminal 'show() { print -r -- "<$BUFFER>"; BUFFER=; zle accept-line }; zle -N show; bindkey "^X" show'
            for line in "$@"; do zpty -w -n terminal "$line"$'\\t\\C-x'; done
            zpty -w terminal 'print fini''shed'
            zpty -r terminal text '*finished*'
            print -r -- "$text"`;
        const out = shell('zsh', '-f', '-c', script, 'zsh', ...asked);
        const lines = [...out.matchAll(/<(irido [^>]*?)[ =,]*>/g)].map((match) => match[1]);
        const start = (line) => line.replace(/[^ =]*$/, '');
        assert.deepEqual(lines, asked.map((line, i) => start(line) + wanted[i]));
    });
});
