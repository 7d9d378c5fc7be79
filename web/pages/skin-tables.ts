// The tables of the page of a skin: first spikes, rates by class and phase, classes, densities, parameters.

import {chooser, fill, h} from "../base/dom";
import {Cell, quantity, symbol} from "../base/text";
import type {ParameterData} from "../data/document";
import type {ClassSummary, RateRow} from "../data/skin";
import {Column, table} from "../panels/table";
import {folded, section} from "../shell";
import type {SkinRecording} from "../skin/recording";

const chip = (colour: string) => h("span", {class: "chip", style: `background: ${colour}`});
const number = (name: string, decimals?: number): Column => ({name, decimals, isNumber: true});
const millimetres = (metres: number) => quantity(metres, "m", true);

/// The column of the class, with its colour.
function classColumn(skin: SkinRecording, name: string): Column {
    const colours = new Map(skin.classes.map((one) => [one.name, one.colour]));
    return {name, show: (value) => [chip(colours.get(String(value).split("#")[0]) || "transparent"), String(value)]};
}

/// The afferents that fired first, each with its delay after the first force on the skin.
export function showFirstTable(host: Element, skin: SkinRecording) {
    const {first_spikes, input} = skin.data.summary, touched = input.touched_from_s;
    const rows = first_spikes.map(({afferent, region, time_s}) => [afferent, region, time_s, touched === null ? null : (time_s - skin.clock.t0 - touched) * 1e3]);
    if (!rows.length) host.append(h("p", {class: "note"}, "No afferent fired."));
    else host.append(table({name: "first spikes", columns: [classColumn(skin, "afferent"), {name: "region"}, number("first spike (s)", 6), number("after the first force (ms)", 3)], rows}));
}

const RATES: [keyof RateRow, string, number?][] = [["phase", "phase"], ["afferents", "afferents", 0], ["touched", "touched", 0], ["active", "active", 0], ["spikes", "spikes", 0],
    ["rate_while_touched_Hz", "rate while touched (Hz)", 1], ["rate_of_active_Hz", "mean rate of active (Hz)", 1], ["max_rate_Hz", "max (Hz, over the phase)", 1],
    ["first_spike_s", "first spike (s)", 4], ["median_first_spike_s", "median first spike (s)", 4]];

/// The rates of all classes and phases in a region; "all" is the complete skin.
export function showRates(host: Element, skin: SkinRecording) {
    const {rates, input} = skin.data.summary, node = section(host, "rates", "Classes and phases"), box = h("div"), regions = [...new Set(rates.map(({region}) => region))];
    const columns = RATES.filter(([key]) => input.phases.length || key !== "phase");
    const show = (region: string) => fill(box, table({
        name: "rates", columns: [classColumn(skin, "class"), ...columns.map(([key, name, decimals]) => (key === "phase" ? {name} : number(name, decimals)))],
        rows: rates.filter((row) => row.region === region).map((row) => [row.afferent, ...columns.map(([key]) => row[key])])}));
    if (regions.length > 1) node.append(h("div", {class: "bar"}, chooser("Region", regions, 0, (k) => show(regions[k]))));
    node.append(box, h("p", {class: "note"}, "An afferent counts as touched while the site with its largest weight has force. Rate while touched: spikes of all afferents while touched, divided by the " +
        "sum of the times for which each is touched. Max: the mean rate, over the phase, of the afferent with the most spikes."));
    show(regions[0]);
}

export function showClasses(host: Element, skin: SkinRecording) {
    const {skin: about, classes} = skin.data.summary;
    const node = section(host, "classes", "Afferents of the skin", [about.description, `${about.afferents} afferents`, `seed ${about.seed}`].filter(Boolean).join("; "));
    const rows = classes.map((one, k): Cell[] => {
        const {composition, description, source} = skin.data.classes[k], {velocity_m_s, standard_deviation_m_s} = one.conduction;
        const speed = velocity_m_s ? `${quantity(velocity_m_s, "m/s", true)}${standard_deviation_m_s ? ` ± ${quantity(standard_deviation_m_s, "m/s", true)}` : ""}` : "no delay";
        return [one.name, one.afferents, composition, fieldText(one.receptive_field), speed, [description, one.source || source].filter(Boolean).join("; ")];
    });
    node.append(table({name: "classes", columns: [classColumn(skin, "class"), number("afferents", 0), ...["model", "receptive field", "conduction velocity", "description and source"].map((name) => ({name}))], rows}));
    showDensities(node, skin);
    showSources(node, skin);
}

function fieldText({sigma_m, depth_m, surround, hot_spots, hot_spot_spread_m}: ClassSummary["receptive_field"]): string {
    const shape = depth_m ? `stress at ${millimetres(depth_m)}${surround ? `, surround ${surround}` : ""}` : sigma_m ? `Gaussian, σ ${millimetres(sigma_m)}` : "nearest site";
    return `${shape}${hot_spots > 1 ? `; ${hot_spots} hot spots, spread ${millimetres(hot_spot_spread_m)}` : ""}`;
}

/// The number of afferents of each class in each region, and their density.
function showDensities(host: Element, skin: SkinRecording) {
    const {classes, skin: about} = skin.data.summary, names = skin.data.regions;
    if (names.length < 2 && !classes.some((one) => Object.values(one.regions).some((region) => region.afferents_per_cm2 !== undefined))) return;
    const density = (k: number, name: string) => classes[k].regions[name].afferents_per_cm2;
    const columns: Column[] = [{name: "region"}, number("area (cm²)", 2), ...skin.classes.map(({name, colour}, k): Column => ({
        name, isNumber: true, label: [chip(colour), name],
        show: (value, row) => [String(value), density(k, names[row]) === undefined ? null : h("span", {class: "unit"}, ` (${+density(k, names[row])!.toPrecision(3)} /cm²)`)]}))];
    host.append(table({name: "densities", columns, rows: names.map((name) => [name, about.regions[name].area_cm2 || null, ...classes.map((one) => one.regions[name].afferents)])}));
}

/// The literature from which the population's numbers are; a source of several numbers is listed once.
function showSources(host: Element, skin: SkinRecording) {
    const {classes, skin: about} = skin.data.summary, entries = new Map<string, string[]>();
    const add = (source: string, text: string) => entries.set(source, [...(entries.get(source) || []), text]);
    about.sources.forEach(({quantity: what, source}) => add(source, what));
    classes.forEach(({name, sources: own}) => own.forEach(({quantity: what, source}) => add(source, `${what} of ${name}`)));
    if (entries.size) folded(host, "sources", "Sources", `${entries.size}`, "", (box) => box.append(h("ul", {class: "sources", "aria-label": "sources"}, ...Array.from(entries, ([source, texts]) => h("li", {}, `${texts.join(", ")}: ${source}`)))));
}

export function showParameters(host: Element, skin: SkinRecording) {
    folded(host, "parameters", "Parameters", "", "", (box) => {
        const columns = h("div", {class: "columns"});
        box.append(columns);
        skin.data.classes.forEach(({name, composition, parameters}, k) => columns.append(
            h("div", {}, h("h3", {}, chip(skin.classes[k].colour), name, h("small", {}, ` ${composition}`)), parameterTable(name, parameters))));
    });
}

function parameterTable(name: string, parameters: ParameterData[]): HTMLElement {
    const spread = ({spread: deviation, spread_factor: factor, unit}: ParameterData) => (factor ? ` ×/÷ ${factor}` : deviation ? ` ± ${quantity(deviation, unit, true)}` : "");
    const columns: Column[] = [{name: "parameter", show: (value) => symbol(String(value))}, {name: "value", show: (_, row) => [quantity(parameters[row].value, parameters[row].unit, true) + spread(parameters[row]), parameters[row].set ? h("span", {class: "tag"}, "set") : null]},
                               {name: "default", show: (_, row) => [quantity(parameters[row].default, parameters[row].unit, true)]}, {name: "meaning"}, {name: "source"}];
    return table({name: `parameters of ${name}`, columns, rows: parameters.map((one) => [one.name, one.value, one.default, one.description, one.source])});
}
