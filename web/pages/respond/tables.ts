// The tables of the page: rates, implementations, recording quality, costs, parameters.

import {fill, h} from "../../base/dom";
import {Cell, quantity} from "../../base/text";
import type {AfferentData, CostData, ParameterData, QualityData, TableData} from "../../data/document";
import {Column, table} from "../../panels/table";
import {section} from "../../shell";
import {afferentColours} from "./implementations";

const MAX_ROWS = 2000;  // of a table; more would slow the browser. All rows are in summary.json

/// A table of a page's data. `keep`: the rows that are shown; `startsGroup(row, before)`: true if a line separates a row from the row before.
function dataTable(name: string, {columns, decimals, rows}: TableData, keep: (row: Cell[]) => boolean, startsGroup = (row: Cell[], before: Cell[]) => row[0] !== before[0]): HTMLElement {
    const wanted = rows.filter(keep), shown = wanted.slice(0, MAX_ROWS);
    const isNumber = (c: number) => rows.some((row) => typeof row[c] === "number" || Array.isArray(row[c]));
    const node = table({name, rows: shown, columns: columns.map((text, c): Column => ({name: text, decimals: decimals[c], isNumber: isNumber(c)})),
                        rowClass: (k) => (k && startsGroup(shown[k], shown[k - 1]) ? "group" : "")});
    return wanted.length > MAX_ROWS ? h("div", {}, node, h("p", {class: "note"}, `The first ${MAX_ROWS} of ${wanted.length} rows.`)) : node;
}

/// The measures of the chosen channel or, if the box is checked, of all channels. Returns a function that shows another channel.
export function rateTable(host: Element, data: TableData, channels: number, areAll: boolean, onAll: (areAll: boolean) => void): (channel: string) => void {
    if (!data.rows.length) return () => {};
    const node = section(host, "rates", "Rates"), content = h("div"), column = data.columns.indexOf("channel");
    const box: HTMLInputElement = h("input", {type: "checkbox", id: "all-rows", checked: areAll, onchange: () => { onAll(box.checked); show(shown); }});
    let shown = "";
    const show = (channel: string) => {
        shown = channel;
        fill(content, dataTable("rates", data, (row) => channels < 2 || box.checked || row[column] === channel));
    };
    node.append(...(channels > 1 ? [h("label", {id: "choose-rows"}, box, " All channels")] : []), content);
    return show;
}

/// Comparison of the implementations of each afferent type. Returns a function that shows another channel.
export function implementationTable(host: Element, data: TableData & {cost: number; tau: number}): (channel: string) => void {
    if (!data.rows.length) return () => {};
    const text = `Each implementation is compared with the first of its afferent type. Spikes within ${quantity(2 / data.cost, "s", true)} match; ` +
        `a positive shift means later than the reference. Victor-Purpura cost ${quantity(data.cost, "Hz", true)}, van Rossum time constant ${quantity(data.tau, "s", true)}.`;
    const node = section(host, "comparisons", "Implementations of one afferent type"), content = h("div"), [channel, matched] = ["channel", "matched"].map((name) => data.columns.indexOf(name));
    node.append(h("p", {class: "note"}, text), content);
    return (name) => fill(content, dataTable("implementations", data, (row) => row[channel] === name, (row) => row[matched] === null));
}

/// Quality findings of the recordings, for each recording the warnings first, and the quality metrics of each channel.
export function qualityTable(host: Element, {notes, columns, rows}: QualityData) {
    if (!rows.length) return;
    const node = section(host, "quality", "Recording quality"), findings = notes.map(({text, grave}) => h("li", {class: grave ? "bad" : ""}, text));
    node.append(h("ul", {"aria-label": "findings"}, ...(findings.length ? findings : [h("li", {}, "No problems were found.")])),
                dataTable("recording quality", {columns, decimals: [], rows}, () => true, () => false));
}

const chip = (colour: string) => h("span", {class: "chip", style: `background: ${colour}`});
const short = (value: number, unit: string) => quantity(value, unit, true);

/// Power and area of afferents that are netlists, by block.
export function costTables(host: Element, costs: CostData[] | undefined, afferents: AfferentData[]) {
    if (!costs || !costs.length) return;
    const colours = afferentColours(afferents);
    section(host, "costs", "Power and area").append(h("div", {class: "columns"}, ...costs.map((cost) => costTable(cost, colours[afferents.findIndex(({name}) => name === cost.afferent)]))),
        h("p", {class: "note"}, "Areas are of transistor arrays and capacitors, without wells, wires and pads. For comparison, measured silicon (0.18 µm): 12.33 nW per taxel, " +
            "25 taxels per mm² (Alea et al. 2024, doi:10.1109/TBCAS.2024.3387545). Its piezoelectric taxels generate their own charge and respond to changes only."));
}

function costTable({afferent, rest_force_N, power, area, blocks, afferents}: CostData, colour: string): HTMLElement {
    // Blocks with transistors, and other blocks that take more than a millionth of the delivered power.
    const listed = blocks.filter((one) => one.area.total_m2 || Math.abs(power.op.blocks_W[one.block]) > 1e-6 * power.op.delivered_W);
    const rows: Cell[][] = listed.map((one) => [one.block, power.op.blocks_W[one.block], one.area.total_m2 || null, one.worst_leak ? one.worst_leak.current_A : null]);
    rows.push(["total", power.op.delivered_W, area.total_m2, null]);
    const inUnit = (unit: string) => (value: Cell) => [value === null ? "–" : short(value as number, unit)];
    const mean = power.mean ? `; mean ${short(power.mean.delivered_W, "W")}, of which sensor ${short(power.mean.sensor_W, "W")}` : "";
    const about = `power at rest ${short(power.op.delivered_W, "W")}, of which sensor ${short(power.op.sensor_W, "W")}${mean}.${afferents ? ` Density: ${short(afferents.per_mm2, "")} per mm².` : ""}`;
    return h("div", {}, h("p", {}, chip(colour), h("b", {}, afferent), " ", h("span", {class: "unit"}, about)),
        table({name: `power and area of ${afferent}`, rows, hasTotal: true, columns: [{name: "block"}, {name: "power_W", label: [`power at rest (${short(rest_force_N, "N")})`], isNumber: true, show: inUnit("W")},
            {name: "area_m2", label: ["area (µm²)"], isNumber: true, show: (value) => [value === null ? "–" : ((value as number) * 1e12).toFixed(0)]},
            {name: "leakage_A", label: ["leakage when off"], isNumber: true, show: inUnit("A")}]}));
}

/// The parameters of all afferents, with marks at those that the user has set.
export function parameterTables(host: Element, afferents: AfferentData[]) {
    const colours = afferentColours(afferents), listed = afferents.map((one, k) => ({...one, colour: colours[k]})).filter((one) => one.parameters && one.parameters.length);
    if (listed.length) section(host, "parameters", "Parameters").append(h("div", {class: "columns"}, ...listed.map((one) => parameterTable(one, one.colour))));
}

function parameterTable({name, composition, parameters}: AfferentData, colour: string): HTMLElement {
    const isFirst = (k: number) => !k || parameters[k - 1].component !== parameters[k].component;
    const value = (_: Cell, k: number) => [valueText(parameters[k]), parameters[k].set && h("span", {class: "tag"}, "set")];
    return h("div", {}, h("p", {}, chip(colour), h("b", {}, name), " ", h("span", {class: "unit"}, composition)),
        table({name: `parameters of ${name}`, rows: parameters.map((one) => [one.name, one.component, one.value, one.default, one.description]), rowClass: (k) => (k && isFirst(k) ? "group" : ""),
            columns: [{name: "parameter"}, {name: "model"}, {name: "value", isNumber: true, show: value},
                {name: "default", isNumber: true, show: (_, k) => [short(parameters[k].default, parameters[k].unit)]},
                {name: "description", show: (text, k) => [String(text), parameters[k].source && h("span", {class: "unit"}, ` (${parameters[k].source})`)]}]}));
}

function valueText({value, unit, spread, spread_factor}: ParameterData): string {
    return short(value, unit) + (spread === undefined ? "" : ` ± ${short(spread, unit)}`) + (spread_factor === undefined ? "" : ` ×/÷ ${spread_factor} `);
}
