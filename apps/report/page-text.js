"use strict";
// Formats numbers and names: engineering prefixes, round ticks, symbols with subscripts.

const PREFIXES = {"-15": "f", "-12": "p", "-9": "n", "-6": "µ", "-3": "m", "0": "", "3": "k", "6": "M", "9": "G", "12": "T"};
const GREEK = {tau: "τ", alpha: "α", beta: "β", gamma: "γ", delta: "δ", theta: "θ", lambda: "λ", sigma: "σ", omega: "ω"};

const escaped = (text) => String(text).replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);
/// Units come from files and are inserted into HTML. Valid units contain none of the removed characters.
const unitText = (unit) => (unit === "1" ? "" : String(unit).replace(/[&<>"'`]/g, "").replace(/[oO]hm/g, "Ω"));

/// The power of ten of the prefix that suits a value; 0 for units without prefixes (m^2, %, plain numbers).
function prefixPower(value, unit) {
    const size = Number(Math.abs(value).toPrecision(4));
    if (!size || !Number.isFinite(size) || !/^[A-Za-zΩ]+([ ·/].*)?$/.test(unitText(unit))) return 0;
    return Math.max(-15, Math.min(12, 3 * Math.floor(Math.log10(size) / 3 + 1e-9)));
}

/// "1.250 µA": four digits. `short` omits trailing zeros: "20 Hz".
function quantity(value, unit, short = false) {
    if (value === null || value === undefined || Number.isNaN(value)) return "–";
    if (Math.abs(value) < 1e-18) return quantity(1, unit, true).replace("1", "0");  // the tail of a decay is shown as 0
    const power = prefixPower(value, unit);
    const digits = (value / 10 ** power).toPrecision(4);
    const suffix = PREFIXES[power] + unitText(unit);
    return (short ? String(Number(digits)) : digits).replace("-", "−") + (suffix && "\u00a0" + suffix);
}

/// Table cells: numbers with the decimals of their column, else four digits; an array is a mean with its standard deviation.
function cellText(value, decimals) {
    if (value === null || value === undefined) return "–";
    if (Array.isArray(value)) return value.map((one) => cellText(one, decimals)).join(" ± ");
    if (typeof value !== "number") return String(value);
    return (decimals === undefined ? String(Number(value.toPrecision(4))) : value.toFixed(decimals)).replace("-", "−");
}

/// A time with enough decimals for `resolution`, s.
function timeText(t, resolution) {
    const decimals = Math.max(0, Math.min(12, Math.ceil(-Math.log10(resolution))));
    return t.toFixed(decimals).replace("-", "−") + "\u00a0s";
}

const titleHtml = (title, unit) => escaped(title) + (unit && ` <span class="unit">(${escaped(unit)})</span>`);

/// "I_A" as I with a subscript; names of more than two letters are not italic.
function symbolHtml(name) {
    const [head, ...rest] = name.split("_");
    const letter = GREEK[head] || head;
    const base = letter.length > 2 ? escaped(letter) : `<i>${escaped(letter)}</i>`;
    return rest.length ? `${base}<sub>${escaped(rest.join("_").replace("-", "−"))}</sub>` : base;
}

/// About `count` round values in [lo, hi], spaced by 1, 2 or 5 times a power of ten, and the decimals that they need.
function roundTicks(lo, hi, count) {
    const rough = (hi - lo) / Math.max(count, 1);
    const decade = 10 ** Math.floor(Math.log10(rough));
    const step = decade * [1, 2, 5, 10].find((m) => m * decade >= rough * 0.999);
    const values = [];
    for (let k = Math.ceil(lo / step - 1e-9); k * step <= hi + 1e-9 * step; ++k) values.push(k * step);
    return {values, decimals: Math.max(0, Math.min(12, -Math.floor(Math.log10(step) + 1e-9)))};
}
