// Axes of plots that are not over time: positions, ticks and titles. On a logarithmic axis the position of a value is its log10.

import {PREFIXES, Ticks, fixedText, logTicks, prefixPower, quantity, roundTicks, shortest, unitText} from "../base/text";

export interface Axis {
    name: string;
    unit: string;
    isLog?: boolean;
    words?: string[];                ///< names of the values 0, 1, 2 ..., such as process corners
    marks?: [number, string][];      ///< ticks that replace the round ones: position, text
}

// Only these units take prefixes; "pA" or "degC" do not.
const BASE_UNITS = new Set(["V", "A", "s", "N", "Hz", "F", "S", "W", "m", "C", "J", "Ohm", "ohm"]);

/// An axis with the label of a plot, such as "V_G (V)".
export function axisOf(label: string, isLog = false): Axis {
    const parts = /^(.*\S) \(([^()]*(?:\([^()]*\))?[^()]*)\)$/.exec(label);
    return {name: parts ? parts[1] : label, unit: parts ? parts[2] : "", isLog};
}

export const positionOn = ({isLog}: Axis, value: number) => (isLog ? (value > 0 ? Math.log10(value) : NaN) : value);
export const valueOn = ({isLog}: Axis, position: number) => (isLog ? 10 ** position : position);

/// A value with its unit: "349.5 mV", "85 °C", or the word of an axis with words.
export function textOn({unit, words}: Pick<Axis, "unit" | "words">, value: number | null | undefined): string {
    if (value === null || value === undefined || Number.isNaN(value)) return "–";
    if (words) return words[value] ?? "–";
    if (BASE_UNITS.has(unit)) return quantity(value, unit, true);
    const text = unitText(unit);
    return shortest(Number.isInteger(value) ? value : Number(value.toPrecision(4))) + (text && `\u00a0${text}`);
}

/// The power of ten of the prefix that the numbers of a linear axis from lo to hi share.
export const axisPower = ({unit, isLog, words}: Axis, lo: number, hi: number) =>
    (isLog || words || !BASE_UNITS.has(unit) ? 0 : prefixPower(Math.max(Math.abs(lo), Math.abs(hi)), unit));

export function titleOf({name, unit, isLog}: Axis, power: number): string {
    if (isLog && BASE_UNITS.has(unit)) return name;  // each tick has the unit
    const text = PREFIXES[power] + unitText(unit);
    return text ? `${name} (${text})` : name;
}

/// Ticks between two positions.
export function ticksOf(axis: Axis, lo: number, hi: number, count: number): Ticks {
    if (axis.marks) {
        const texts = new Map(axis.marks.filter(([at]) => at >= lo && at <= hi));
        return {values: [...texts.keys()], text: (v) => texts.get(v) || ""};
    }
    if (axis.words) return {values: axis.words.map((_, k) => k).filter((k) => k >= lo && k <= hi), text: (v) => axis.words![v] || ""};
    if (axis.isLog) return logarithmic(axis, lo, hi, count);
    const scale = 10 ** axisPower(axis, lo, hi), ticks = roundTicks(lo / scale, hi / scale, count);
    return {values: ticks.values.map((v) => v * scale), text: (v) => ticks.text(v / scale)};
}

/// At most twice as many ticks as wanted: 1, 2, 5 of each decade, or decades, or every second decade.
function logarithmic({unit}: Axis, lo: number, hi: number, count: number): Ticks {
    if (hi - lo < 0.25) {  // less than a factor of two
        const ticks = roundTicks(10 ** lo, 10 ** hi, count);
        return {values: ticks.values.filter((v) => v > 0).map(Math.log10), text: (v) => textOn({unit}, Number((10 ** v).toPrecision(8)))};
    }
    const all = logTicks(lo, hi).values, decades = all.filter((v) => Math.abs(v - Math.round(v)) < 1e-9);
    const values = [all, decades, decades.filter((v) => Math.round(v) % 2 === 0), decades.filter((v) => Math.round(v) % 4 === 0)].find((one) => one.length <= 1.5 * count + 1) || decades.slice(0, 1);
    const isBase = BASE_UNITS.has(unit);
    return {values: values.length > 1 ? values : all, text: (v) => (isBase ? quantity(10 ** v, unit, true) : shortest(10 ** v))};
}

/// The range of an axis in words, for screen readers.
export const spanOn = (axis: Axis, lo: number, hi: number) =>
    (axis.isLog ? `from ${textOn(axis, 10 ** lo)} to ${textOn(axis, 10 ** hi)}` : `from ${fixedText(lo, (hi - lo) / 1000 || 1, axis.unit)} to ${fixedText(hi, (hi - lo) / 1000 || 1, axis.unit)}`);
