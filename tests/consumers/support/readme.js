// Blocks of code of the README.
import { readFileSync } from 'node:fs';

const text = readFileSync(new URL('../../../README.md', import.meta.url), 'utf8');

/** The one block of a language ("sh", "python") that contains some words. */
export function readmeBlock(language, words) {
    const blocks = [...text.matchAll(/^```(\w+)\n(.*?)^```$/gms)]
        .filter((match) => match[1] === language && match[2].includes(words))
        .map((match) => match[2]);
    if (blocks.length !== 1)
        throw new Error(`README.md has ${blocks.length} blocks of ${language} with "${words}"`);
    return blocks[0];
}
