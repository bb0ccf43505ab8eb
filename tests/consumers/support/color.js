// Linear sRGB to CIELAB under D65, and CIEDE2000, from their definitions.

/** Columns of the matrix from the primaries' chromaticities, scaled so that they sum to the white. */
function xyzFromRgb(primaries, white) {
    const columns = primaries.map(([x, y]) => [x / y, 1, (1 - x - y) / y]);
    const determinant = ([a, b, c]) => a[0] * (b[1] * c[2] - b[2] * c[1])
        - b[0] * (a[1] * c[2] - a[2] * c[1]) + c[0] * (a[1] * b[2] - a[2] * b[1]);
    const all = determinant(columns);
    return columns.map((column, i) => {
        const replaced = columns.map((other, j) => i === j ? white : other);
        const scale = determinant(replaced) / all;
        return column.map((value) => value * scale);
    });
}

const whiteXy = [0.3127, 0.329];
export const white = [whiteXy[0] / whiteXy[1], 1, (1 - whiteXy[0] - whiteXy[1]) / whiteXy[1]];
const columns = xyzFromRgb([[0.64, 0.33], [0.3, 0.6], [0.15, 0.06]], white);

export function labFromSrgb(rgb) {
    const xyz = [0, 1, 2].map((i) => rgb.reduce((sum, value, j) => sum + columns[j][i] * value, 0));
    const [x, y, z] = xyz.map((value, i) => {
        const t = value / white[i], d = 6 / 29;
        return t > d ** 3 ? Math.cbrt(t) : t / (3 * d * d) + 4 / 29;
    });
    return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

/** CIEDE2000 (Sharma, Wu and Dalal 2005) of two colours in CIELAB. */
export function deltaE2000([L1, a1, b1], [L2, a2, b2]) {
    const rad = Math.PI / 180;
    const meanC = (Math.hypot(a1, b1) + Math.hypot(a2, b2)) / 2;
    const G = 0.5 * (1 - Math.sqrt(meanC ** 7 / (meanC ** 7 + 25 ** 7)));
    const polar = (a, b) => {
        const x = (1 + G) * a;
        const hue = x === 0 && b === 0 ? 0 : Math.atan2(b, x) / rad;
        return [Math.hypot(x, b), hue < 0 ? hue + 360 : hue];
    };
    const [C1, h1] = polar(a1, b1), [C2, h2] = polar(a2, b2);
    const grey = C1 * C2 === 0;
    let dh = grey ? 0 : h2 - h1;
    if (dh > 180) dh -= 360;
    if (dh < -180) dh += 360;
    const dL = L2 - L1, dC = C2 - C1, dH = 2 * Math.sqrt(C1 * C2) * Math.sin(dh / 2 * rad);
    const L = (L1 + L2) / 2, C = (C1 + C2) / 2;
    let h = h1 + h2;
    if (!grey) h = Math.abs(h1 - h2) <= 180 ? h / 2 : h < 360 ? h / 2 + 180 : h / 2 - 180;
    const T = 1 - 0.17 * Math.cos((h - 30) * rad) + 0.24 * Math.cos(2 * h * rad)
        + 0.32 * Math.cos((3 * h + 6) * rad) - 0.2 * Math.cos((4 * h - 63) * rad);
    const turn = 30 * Math.exp(-(((h - 275) / 25) ** 2));
    const R = -2 * Math.sqrt(C ** 7 / (C ** 7 + 25 ** 7)) * Math.sin(2 * turn * rad);
    const SL = 1 + 0.015 * (L - 50) ** 2 / Math.sqrt(20 + (L - 50) ** 2);
    const SC = 1 + 0.045 * C, SH = 1 + 0.015 * C * T;
    return Math.sqrt((dL / SL) ** 2 + (dC / SC) ** 2 + (dH / SH) ** 2 + R * (dC / SC) * (dH / SH));
}
