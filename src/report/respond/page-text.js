"use strict";
// Formats numbers and names: engineering prefixes, round ticks, symbols with subscripts.

// SI prefixes by power of ten
const PREFIXES = {"-15": "f", "-12": "p", "-9": "n", "-6": "µ", "-3": "m", "0": "", "3": "k", "6": "M", "9": "G", "12": "T"};
const GREEK = {tau: "τ", alpha: "α", beta: "β", gamma: "γ", delta: "δ", theta: "θ", lambda: "λ", sigma: "σ", omega: "ω"};

const escaped = (text) => String(text).replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);
/// A unit as HTML. Units come from files, so characters that HTML interprets are removed; valid units contain none of them.
const unitText = (unit) => (unit === "1" ? "" : String(unit).replace(/[&<>"'`]/g, "").replace(/[oO]hm/g, "Ω"));

/// The power of ten of the SI prefix that suits a value: -3 for 0.02 V. It is 0 for units that take no prefix (m^2, %, plain numbers), and at least 0 for Hz.
function prefixPower(value, unit) {
    const size = Number(Math.abs(value).toPrecision(4));
    if (!size || !Number.isFinite(size) || !/^[A-Za-zΩ]+([ ·/].*)?$/.test(unitText(unit))) return 0;
    return Math.max(unit === "Hz" ? 0 : -15, Math.min(12, 3 * Math.floor(Math.log10(size) / 3 + 1e-9)));
}

/// A value with four digits, SI prefix and unit: "1.250 µA". `short` omits trailing zeros: "20 Hz".
function quantity(value, unit, short = false) {
    if (value === null || value === undefined || Number.isNaN(value)) return "–";
    if (Math.abs(value) < 1e-18) return quantity(1, unit, true).replace("1", "0");  // such as the tail of an exponential decay
    const power = prefixPower(value, unit);
    const digits = (value / 10 ** power).toPrecision(4);
    const suffix = PREFIXES[power] + unitText(unit);
    return (short ? String(Number(digits)) : digits).replace("-", "−") + (suffix && "\u00a0" + suffix);
}

/// The text of a table cell. A number has `decimals` decimals, or four digits if that is undefined; an array is a mean with its standard
/// deviation; null is a dash.
function cellText(value, decimals) {
    if (value === null || value === undefined) return "–";
    if (Array.isArray(value)) return value.map((one) => cellText(one, decimals)).join(" ± ");
    if (typeof value !== "number") return String(value);
    return (decimals === undefined ? String(Number(value.toPrecision(4))) : value.toFixed(decimals)).replace("-", "−");
}

/// A time t (s) with enough decimals to show differences of `resolution` (s).
function timeText(t, resolution) {
    const decimals = Math.max(0, Math.min(12, Math.ceil(-Math.log10(resolution))));
    return t.toFixed(decimals).replace("-", "−") + "\u00a0s";
}

/// A title as HTML, with the unit in parentheses unless it is empty.
const titleHtml = (title, unit) => escaped(title) + (unit && ` <span class="unit">(${escaped(unit)})</span>`);

/// A symbol as HTML: "I_A" is an italic I with the subscript A. Names of more than two letters are not italic.
function symbolHtml(name) {
    const [head, ...rest] = name.split("_");
    const letter = GREEK[head] || head;
    const base = letter.length > 2 ? escaped(letter) : `<i>${escaped(letter)}</i>`;
    return rest.length ? `${base}<sub>${escaped(rest.join("_").replace("-", "−"))}</sub>` : base;
}

/// About `count` round values in [lo, hi], spaced by 1, 2 or 5 times a power of ten, and the number of decimals that their text needs.
function roundTicks(lo, hi, count) {
    const rough = (hi - lo) / Math.max(count, 1);
    const decade = 10 ** Math.floor(Math.log10(rough));
    const step = decade * [1, 2, 5, 10].find((m) => m * decade >= rough * 0.999);
    const values = [];
    for (let k = Math.ceil(lo / step - 1e-9); k * step <= hi + 1e-9 * step; ++k) values.push(k * step);
    return {values, decimals: Math.max(0, Math.min(12, -Math.floor(Math.log10(step) + 1e-9)))};
}
