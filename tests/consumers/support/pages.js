// Blocks of code of README.md and the pages in docs/.
import { readFileSync, readdirSync } from 'node:fs';

const root = new URL('../../../', import.meta.url);
const pages = ['README.md', ...readdirSync(new URL('docs/', root)).filter((name) => name.endsWith('.md')).map((name) => `docs/${name}`)];
const text = pages.map((page) => readFileSync(new URL(page, root), 'utf8')).join('\n');

/** The one block of a language ("sh", "python") that contains some words. */
export function pageBlock(language, words) {
    const blocks = [...text.matchAll(/^```(\w+)\n(.*?)^```$/gms)]
        .filter((match) => match[1] === language && match[2].includes(words))
        .map((match) => match[2]);
    if (blocks.length !== 1)
        throw new Error(`the pages have ${blocks.length} blocks of ${language} with "${words}"`);
    return blocks[0];
}
