// A slider and a number field for each parameter of a catalogue. Names, units, ranges and defaults are those of the engine.

import {h} from "../base/dom";
import {quantity, shortest, symbol, unitText} from "../base/text";
import type {Parameter, Setting} from "./catalogue";

const STEPS = 1000;  // of a slider

interface SliderScale { low: number; high: number; isLog: boolean }

/// The range of a slider: that of the parameter if it is finite and not wider than three decades, else a decade around the default, inside the range.
function scaleOf({default: value, low, high}: Parameter): SliderScale | null {
    const min = low ?? -Infinity, max = high ?? Infinity;
    if (Number.isFinite(min) && Number.isFinite(max) && (min > 0 ? max / min <= 1000 : value === 0 || max <= 20 * Math.abs(value))) return {low: min, high: max, isLog: min > 0 && max / min > 20};
    if (value === 0) return null;
    const [a, b] = value > 0 ? [value / 10, value * 10] : [value * 10, value / 10];
    return {low: Math.max(a, min), high: Math.min(b, max), isLog: value > 0};
}

const positionOf = ({low, high, isLog}: SliderScale, value: number) => STEPS * (isLog ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low));
const valueOf = ({low, high, isLog}: SliderScale, position: number) => Number((isLog ? low * (high / low) ** (position / STEPS) : low + (high - low) * position / STEPS).toPrecision(4));

const rangeText = ({low, high, unit}: Parameter) =>
    low === null && high === null ? "any value" : low === null ? `at most ${quantity(high, unit, true)}` : high === null ? `at least ${quantity(low, unit, true)}` : `${quantity(low, unit, true)} to ${quantity(high, unit, true)}`;

/// Changes a setting to a text as the engine reads it ("25Hz"), or to its default; see SettingQueue.change().
export type Change = (text: string | null) => Promise<boolean | null>;

/// A field for numbers would leave out a typed comma, so that "1,5" became 15.
function pointForComma(event: KeyboardEvent) {
    if (event.key !== "," || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    document.execCommand("insertText", false, ".");
}

/// A control for one parameter. After a refused change it shows the last value that the engine has accepted.
export function parameterControl(parameter: Parameter, value: number, change: Change): HTMLElement {
    const scale = scaleOf(parameter), unit = unitText(parameter.unit);
    let accepted = value;
    const number: HTMLInputElement = h("input", {type: "number", step: "any", value, min: parameter.low, max: parameter.high, "aria-label": `${parameter.name} in ${unit || "1"}`, onchange: () => void set(number.value.trim() ? Number(number.value) : NaN), onkeydown: pointForComma});
    const slider: HTMLInputElement | null = scale && h("input", {type: "range", min: 0, max: STEPS, value: positionOf(scale, value), "aria-label": parameter.name, oninput: () => void set(valueOf(scale, Number(slider!.value)))});
    const reset = h("button", {type: "button", title: `Default: ${quantity(parameter.default, parameter.unit, true)}`, "aria-label": `Default of ${parameter.name}`, onclick: () => void set(parameter.default)}, "↺");
    const show = (v: number) => {
        number.value = String(v);
        if (slider && scale) slider.value = String(positionOf(scale, v));
    };
    const set = async (v: number) => {
        show(Number.isFinite(v) ? v : accepted);
        if (!Number.isFinite(v)) return;
        const isAccepted = await change(v === parameter.default ? null : shortest(v).replace("−", "-") + unit);
        if (isAccepted) accepted = v;
        else if (isAccepted === false) show(accepted);
    };
    return h("div", {class: "parameter", "data-parameter": parameter.name, title: `${parameter.description} (${rangeText(parameter)}). ${parameter.source || ""}`},
        h("span", {class: "parameter-name"}, ...symbol(parameter.name)), slider || h("span"), number, h("span", {class: "unit"}, unit), reset,
        h("small", {class: "parameter-about"}, `${parameter.description}; ${rangeText(parameter)}`));
}

/// A control for a setting of a circuit that is not a parameter: supply, temperature, corner, size of an array.
export function settingControl(setting: Setting, value: string | undefined, change: Change): HTMLElement {
    const {name, kind, unit, choices = [], description} = setting, own = String(setting.value ?? ""), current = value ?? own;
    let accepted = current;
    const set = async (typed: string) => {
        const text = typed.trim() || own;  // an empty field is the default
        const isAccepted = await change(text === own ? null : text);
        if (isAccepted) accepted = text;
        if (isAccepted === false || (isAccepted && field.value === typed)) field.value = accepted;  // unless the user types the next value
    };
    const field: HTMLInputElement | HTMLSelectElement = kind === "choice"
        ? h("select", {"aria-label": name, onchange: () => void set(field.value)}, ...choices.map((text) => h("option", {selected: text === current}, text)))
        : h("input", {type: "text", value: current, size: 8, "aria-label": name, onchange: () => void set(field.value)});
    return h("div", {class: "parameter", "data-parameter": name, title: description}, h("span", {class: "parameter-name"}, name), h("span"), field, h("span", {class: "unit"}, unitText(unit)), h("span"),
        h("small", {class: "parameter-about"}, description));
}
