// Tables of colours: sampled between their samples, against irido's own colours there.
import { facetJobs } from './facets.js';
import assert from 'node:assert/strict';
import { csv, iridoEach, randomNumbers } from '../support/irido.js';
import { deltaE2000, labFromSrgb } from '../support/color.js';
import { axis, flat, interpolatedIn, largestDifference, makeTable, rows, snippet, statedError } from './jobs.js';

const film = 'air | 1.33@400 | 1.9+1.5i';
const thickness = 'layers.0.thickness_nm', index = 'layers.0.material', spread = 'layers.0.thickness_sigma_nm';

// rows of the published test data of CIEDE2000
for (const [first, second, difference] of [
    [[50, 2.6772, -79.7751], [50, 0, -82.7485], 2.0425],
    [[50, 2.5, 0], [73, 25, -18], 27.1492],
    [[50, 2.5, 0], [50, 0, -2.5], 4.3065],
    [[60.2574, -34.0099, 36.2677], [60.4626, -34.1751, 39.4387], 1.2644],
    [[2.0776, 0.0795, -1.135], [0.9033, -0.0636, -0.5514], 0.9082],
])
    assert.ok(Math.abs(deltaE2000(first, second) - difference) < 5e-5);

/** Linear sRGB at an angle by its cosine, with values of the stack replaced. */
async function colors(points) {
    const commands = points.map(({ cosine, values }) => ['color', film,
        ...Object.entries(values).flatMap(([path, value]) => ['--set', `${path}=${value}`]),
        '-a', 90 - Math.asin(cosine) * 180 / Math.PI]);
    return (await iridoEach(commands)).map((text) => {
        const [{ r, g, b }] = csv(text);
        return [Number(r), Number(g), Number(b)];
    });
}

function checkColors(expected, samples, metadata) {
    return (values) => {
        const actual = rows(values, 3);
        largestDifference(actual, samples, 1e-5);
        const differences = actual.map((rgb, i) => deltaE2000(labFromSrgb(rgb), labFromSrgb(expected[i])));
        const largest = Math.max(...differences), stated = statedError(metadata);
        assert.equal(metadata.error.measure, 'delta_e_2000');
        assert.ok(largest <= stated, `Delta E 2000 is ${largest}, stated are ${stated}`);
        return `${actual.length} points, largest Delta E 2000 ${largest.toPrecision(2)}, stated ${stated.toPrecision(2)}`;
    };
}

export async function makeJobs(folder) {
    const random = randomNumbers(1), jobs = [];
    const add = async (name, types, args, count, point, call) => {
        const points = Array.from({ length: count }, point);
        const expected = await colors(points);
        for (const type of types) {
            const file = `${name.replaceAll(' ', '-')}-${type}.ktx2`;
            const metadata = makeTable(folder, file, 'color', film, '--dtype', type, ...args);
            const samples = interpolatedIn(`${folder}/${file}`, points);
            jobs.push({
                name: `${name}, ${type}`,
                tables: { table: `/tables/${file}` },
                source: snippet('color'),
                result: `return vec4(${call(metadata.axes.map(axis))}, 1.0);`,
                points: flat(points.map(({ place, level }) => level === undefined ? place : [...place, level])),
                check: checkColors(expected, samples, metadata),
            });
        }
    };
    const free = (path, first, last) => ({ path, value: random(first, last) });
    const pointOf = (...varied) => {
        const cosine = random();
        return {
            cosine,
            values: Object.fromEntries(varied.map(({ path, value }) => [path, value])),
            place: [cosine, ...varied.map(({ value }) => value)],
        };
    };
    await add('over angle and thickness', ['f16', 'f32'], ['--vary', `${thickness}=0:1000/512`, '--cos', '0:1/64'], 100,
        () => pointOf(free(thickness, 0, 1000)),
        ([angle, value]) => `irido_color(table, ${angle}, ${value}, a.x, a.y)`);
    await add('over the angle', ['f16', 'f32'], ['--cos', '0:1/64'], 25, () => pointOf(),
        ([angle]) => `irido_color_of_angle(table, ${angle}, a.x)`);
    await add('over two values', ['f16'], ['--vary', `${index}=1.2:1.8/16`, '--vary', `${thickness}=0:500/128`,
        '--cos', '0:1/16'], 50,
        () => pointOf(free(index, 1.2, 1.8), free(thickness, 0, 500)),
        ([angle, first, second]) => `irido_color_of_two(table, ${angle}, ${first}, ${second}, a.x, a.y, a.z)`);
    const sigmas = [0, 30, 60];
    await add('with spreads', ['f16'], ['--vary', `${thickness}=200:1000/256`, '--cos', '0:1/16',
        '--sigma', sigmas.join()], 60,
        () => {
            const level = Math.floor(random() * sigmas.length);
            const { cosine, values, place } = pointOf(free(thickness, 200, 1000));
            return { cosine, values: { ...values, [spread]: sigmas[level] }, place, level };
        },
        ([, angle, value]) => `irido_color_of_spread(table, ${angle}, ${value}, a.x, a.y, a.z)`);
    // the same between two levels, whose colours are mixed
    const places = Array.from({ length: 60 }, () =>
        ({ place: [random(), random(200, 1000)], level: random(0, sigmas.length - 1) }));
    const mixed = interpolatedIn(`${folder}/with-spreads-f16.ktx2`, places);
    jobs.push({
        ...jobs.at(-1),
        name: 'between two spreads, f16',
        points: flat(places.map(({ place, level }) => [...place, level])),
        check: (values) => largestDifference(rows(values, 3), mixed, 1e-5),
    });
    return [...jobs, ...facetJobs(folder)];
}
