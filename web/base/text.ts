// Formats numbers and names: engineering prefixes, round ticks, symbols with subscripts.

import {Child, h} from "./dom";

// SI prefixes by power of ten
export const PREFIXES: Record<number, string> = {[-15]: "f", [-12]: "p", [-9]: "n", [-6]: "µ", [-3]: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"};
const GREEK: Record<string, string> = {tau: "τ", alpha: "α", beta: "β", gamma: "γ", delta: "δ", theta: "θ", lambda: "λ", sigma: "σ", omega: "ω"};

const withMinus = (text: string) => text.replace("-", "−");
export const unitText = (unit: string) => (unit === "1" ? "" : unit.replace(/[oO]hm/g, "Ω").replace(/^degC$/, "°C").replace(/^u(?=[A-Z])/, "µ").replace(/sqrt\(Hz\)/, "√Hz"));

/// The power of ten of the SI prefix that suits a value: -3 for 0.02 V. It is 0 for units that take no prefix (m^2, %, plain numbers), and at
/// least 0 for Hz.
export function prefixPower(value: number, unit: string): number {
    const size = Number(Math.abs(value).toPrecision(4));
    if (!size || !Number.isFinite(size) || !/^[A-Za-zΩ]+([ ·/].*)?$/.test(unitText(unit))) return 0;
    return Math.max(unit === "Hz" ? 0 : -15, Math.min(12, 3 * Math.floor(Math.log10(size) / 3 + 1e-9)));
}

/// A value with four digits, SI prefix and unit: "1.250 µA". `short` omits trailing zeros: "20 Hz".
export function quantity(value: number | null | undefined, unit: string, short = false): string {
    if (value === null || value === undefined || Number.isNaN(value)) return "–";
    if (Math.abs(value) < 1e-18) return quantity(1, unit, true).replace("1", "0");  // such as the tail of an exponential decay
    const power = prefixPower(value, unit);
    const digits = (value / 10 ** power).toPrecision(4);
    const suffix = PREFIXES[power] + unitText(unit);
    return withMinus(short ? String(Number(digits)) : digits) + (suffix && "\u00a0" + suffix);
}

/// A number of single precision without the digits that it does not have: 0.1, not 0.10000000149.
export const plainNumber = (value: number) => Number(value.toPrecision(7));

export type Cell = string | number | boolean | null | undefined | Cell[];

/// The text of a table cell. A number has `decimals` decimals, or four digits if that is not given; an array is a mean with its standard
/// deviation; null is a dash.
export function cellText(value: Cell, decimals?: number | null): string {
    if (value === null || value === undefined) return "–";
    if (Array.isArray(value)) return value.map((one) => cellText(one, decimals)).join(" ± ");
    if (typeof value !== "number") return String(value);
    return withMinus(decimals === undefined || decimals === null ? String(Number(value.toPrecision(4))) : value.toFixed(decimals));
}

/// A value with enough decimals to show differences of `resolution`, and its unit.
export function fixedText(value: number, resolution: number, unit = "s"): string {
    const decimals = Math.max(0, Math.min(12, Math.ceil(-Math.log10(resolution))));
    return withMinus(value.toFixed(decimals)) + (unit && "\u00a0" + unitText(unit));
}

/// A symbol: "I_A" is an italic I with the subscript A. Names of more than two letters are not italic.
export function symbol(name: string): Child[] {
    const [head, ...rest] = name.split("_");
    const letter = GREEK[head] || head;
    return [letter.length > 2 ? letter : h("i", {}, letter), rest.length > 0 && h("sub", {}, withMinus(rest.join("_")))];
}

export interface Ticks { values: number[]; text: (value: number) => string }

/// About `count` round values in [lo, hi], spaced by 1, 2 or 5 times a power of ten. The texts have the decimals that the spacing needs.
export function roundTicks(lo: number, hi: number, count: number): Ticks {
    const rough = (hi - lo) / Math.max(count, 1);
    const decade = 10 ** Math.floor(Math.log10(rough));
    const step = decade * [1, 2, 5, 10].find((m) => m * decade >= rough * 0.999)!;
    const values: number[] = [];
    for (let k = Math.ceil(lo / step - 1e-9); k * step <= hi + 1e-9 * step; ++k) values.push(k * step);
    const decimals = Math.max(0, Math.min(12, -Math.floor(Math.log10(step) + 1e-9)));
    const most = Math.max(Math.abs(lo), Math.abs(hi)), isPlain = step >= 1e-4 && (most < 1e6 || (most < 1e9 && most / step > 1e5));  // six digits would not distinguish them
    return {values, text: (v) => (isPlain ? withMinus(v.toFixed(decimals)) : shortest(v))};
}

/// A number on an axis: up to six digits, with an exponent if it is very large or small.
export function shortest(v: number): string {
    const number = Number(v.toPrecision(6)), size = Math.abs(number);
    return withMinus(size !== 0 && (size < 1e-3 || size >= 1e6) ? number.toExponential().replace("e+", "e") : String(number));
}

/// Ticks of a logarithmic axis, whose positions are log10 of the values.
export function logTicks(lo: number, hi: number): Ticks {
    const values: number[] = [], mantissas = hi - lo > 5 ? [1] : [1, 2, 5];
    for (let decade = Math.floor(lo); decade <= Math.ceil(hi); ++decade)
        for (const m of mantissas) {
            const v = decade + Math.log10(m);
            if (v >= lo - 1e-9 && v <= hi + 1e-9) values.push(v);
        }
    return {values, text: (v) => shortest(10 ** v)};
}
