// The tables of the page of a sweep.

import {Child, h} from "../base/dom";
import {label} from "../base/label";
import {Cell, plainNumber, unitText} from "../base/text";
import type {MeasureSummary, PointSummary} from "../data/sweep";
import {textOn} from "../panels/axis";
import {Estimate, fractionBar} from "../panels/bars";
import {Column, table} from "../panels/table";
import {section} from "../shell";
import {Sweep, limitsOf, limitsText, percent} from "./sweep-data";

/// "60 items, all finished; 2 diverged".
export function openingText({summary: {items, finished, all}}: Sweep): string {
    const parts = [finished === items ? `${items} items, all finished` : `${finished} of ${items} items are finished`];
    if (all.truncated) parts.push(`${all.truncated} truncated (too many steps or iterations)`);
    if (all.diverged) parts.push(`${all.diverged} diverged`);
    return parts.join("; ");
}

const interval = ({low, high}: Estimate, text: (value: number | null) => string): Child => (low === null && high === null ? null : h("span", {class: "range"}, ` ${text(low)} … ${text(high)}`));
const headed = (name: string, unit: string): Child[] => [name, unit ? h("span", {class: "unit"}, ` (${unitText(unit)})`) : null];
const columnName = (name: string, unit: string) => (unit ? `${name} (${unitText(unit)})` : name);

/// A table of the parameters that the sweep varies, and their values.
export function showAxes(host: Element, sweep: Sweep) {
    if (!sweep.summary.axes.length) return;
    const valuesText = (a: number) => {
        const levels = sweep.levels(a), text = (value: number) => sweep.levelText(a, value);
        return levels.length <= 12 ? levels.map(text).join(", ") : `${text(levels[0])} … ${text(levels[levels.length - 1])}${sweep.isGrid ? ` (${levels.length} values)` : ""}`;
    };
    section(host, "axes", "Varied").append(table({name: "axes", isStacked: true, columns: [{name: "axis"}, {name: "description", class: "unit what"}, {name: "values", class: "reason"}],
        rows: sweep.summary.axes.map(({name, description}, a) => [name, description, valuesText(a)])}));
}

/// The yield: of all limits together, then of each measure with limits. Only items that are drawn at random have a confidence interval; those of several
/// grid points together are not.
export function showYields(host: Element, sweep: Sweep) {
    const {all} = sweep.summary, rows: {name: string; limits: string; estimate: Estimate}[] = [{name: sweep.measures.some((one) => limitsOf(one).length) ? "all limits" : "completed", limits: "", estimate: all.yield}];
    all.measures.forEach((one, k) => one.yield && rows.push({name: one.name, limits: limitsText(sweep.measures[k]), estimate: one.yield}));
    host.append(table({name: "yield", isStacked: true,
        columns: [{name: ""}, {name: "limits"}, {name: "passed", isNumber: true, show: (value) => [`${value} of ${all.items}`]},
                  {name: sweep.isGrid ? "passed (%)" : sweep.isMixed ? "yield (%)" : "yield (%), 95 % CI", isNumber: true, show: (value, k) => [`${percent(value as number)} %`, interval(rows[k].estimate, percent)]},
                  {name: "bar", label: [""], class: "bar-cell", show: (_, k) => [fractionBar(rows[k].estimate)]}],
        rows: rows.map(({name, limits, estimate}) => [name, limits, Math.round((estimate.value || 0) * all.items), estimate.value, null])}));
}

/// The distribution of each measure over randomly drawn items.
export function showDistributions(host: Element, sweep: Sweep) {
    const {all, quantiles} = sweep.summary;
    const text = (k: number) => (value: Cell) => textOn(sweep.measures[k], value as number | null);
    const estimate = (pick: (one: MeasureSummary) => Estimate) => (value: Cell, k: number): Child[] => [text(k)(value), interval(pick(all.measures[k]), text(k))];
    const plain = (value: Cell, k: number): Child[] => [text(k)(value)];
    const normal = ({normal_plot: {correlation, min_of_normal_samples: floor}}: MeasureSummary) => (correlation === null ? "–" : `${correlation.toFixed(4)}, ${correlation >= (floor ?? 0) ? "normal" : "not normal"}`);
    host.append(table({name: "measures", isStacked: true, columns: [
        {name: "measure"}, {name: "items", isNumber: true}, {name: "mean", isNumber: true, show: estimate((one) => one.mean)}, {name: "sigma", isNumber: true, show: estimate((one) => one.sigma)},
        {name: "min", isNumber: true, show: plain},
        ...quantiles.map((q, i): Column => ({name: q === 0.5 ? "median" : `${100 * q} %`, isNumber: true, show: (value, k) => [h("span", sweep.isMixed ? {} : {title: `${text(k)(all.measures[k].quantiles[i]?.low)} … ${text(k)(all.measures[k].quantiles[i]?.high)}`}, text(k)(value))]})),
        {name: "max", isNumber: true, show: plain}, {name: "normality (r)"}, {name: "unit", class: "file-only"}],
        rows: all.measures.map((one, k) => [one.name, one.items, one.mean.value, one.sigma.value, one.min, ...quantiles.map((_, i) => one.quantiles[i]?.value ?? null), one.max, normal(one), sweep.measures[k].unit])}));
}

/// The results at each point of the grid: means, and for random items also the standard deviation and the yield.
export function showPoints(host: Element, sweep: Sweep) {
    const {points} = sweep.summary;
    if (points.length < 2 || points.length > 400) return;
    const isRandom = !sweep.isGrid, found = (one: PointSummary, k: number): Cell => (isRandom ? [one.measures[k].mean.value, one.measures[k].sigma.value] : one.measures[k].mean.value);
    const show = (k: number) => (value: Cell): Child[] => [(Array.isArray(value) ? value : [value]).map((one) => textOn(sweep.measures[k], one as number | null)).join(" ± ")];
    const random: Column[] = isRandom ? [{name: "items", isNumber: true}, {name: "yield (%), 95 % CI", isNumber: true, show: (value, k) => [`${percent(value as number)} %`, interval(points[k].yield, percent)]}] : [];
    section(host, "points", "By grid point", isRandom ? "mean ± sigma" : points.some(({items}) => items > 1) ? "means" : "").append(table({name: "grid points", isStacked: true,
        columns: [{name: "point", class: "what"}, ...random, ...sweep.measures.map(({name, unit}, k): Column => ({name: columnName(name, unit), label: headed(name, unit), isNumber: true, show: show(k)}))],
        rows: points.map((one) => [one.point, ...(isRandom ? [one.items, one.yield.value] : []), ...sweep.measures.map((_, k) => found(one, k))])}));
}

/// The axes and devices that explain the variance of each measure and of the yield.
export function showInfluences(host: Element, sweep: Sweep) {
    const rows: Cell[][] = [], estimates: Estimate[] = [];
    const add = (estimate: Estimate, measure: string, factor: string, kind: string, V_T: Cell = null, I_S: Cell = null, at4: Cell = null) => {
        rows.push([measure, factor, kind, estimate.value, null, V_T, I_S, at4]);
        estimates.push(estimate);
    };
    for (const {measure, between_points: points, influences, devices, explained_fraction: explained} of sweep.summary.depends_on) {
        const none = {low: null, high: null};
        for (const {axis, fraction} of points) add({value: fraction, ...none}, measure, axis, "grid axis, of the total variance");
        for (const {axis, fraction} of influences) if (axis && fraction.value >= 0.0005) add(fraction, measure, axis, "random");
        for (const one of devices.slice(0, 8))
            add({value: one.fraction, ...none}, measure, one.device, sweep.data.sizes[one.device] || "", one.fraction_V_T, one.fraction_I_S, measure === "yield" ? null : one.relative_sigma_at_4x_area - 1);
        if (influences.length) add({value: explained, ...none}, measure, "linear model", "of the random variance");
    }
    if (!rows.length) return;
    const part = (value: Cell): Child[] => [value === null ? "" : `${percent(value as number).replace("-", "−")} %`];
    const columns: Column[] = [{name: "measure"}, {name: "factor", class: "factor"}, {name: "is", class: "unit"},
        {name: "variance, 95 % CI", isNumber: true, show: (value, k) => [...part(value), interval(estimates[k], percent)]}, {name: "bar", label: [""], class: "bar-cell", show: (_, k) => [fractionBar(estimates[k])]},
        {name: "by V_T", label: ["by ", ...label("V_T")], isNumber: true, show: part}, {name: "by I_S", label: ["by ", ...label("I_S")], isNumber: true, show: part}, {name: "sigma at 4× area", isNumber: true, show: part}];
    section(host, "influences", "Influences", "share of the variance: of grid axes, of the total; of random parameters, of the variance within a grid point. Only significant effects are listed").append(
        table({name: "influences", isStacked: true, rows, columns: rows.every((row) => row[5] === null) ? columns.slice(0, 5) : columns}));
}

/// Items with their axis values and measures; a measure beyond its limits is marked. `hasReason`: tell why an item failed.
export function itemTable(name: string, sweep: Sweep, rows: number[], hasReason = false): HTMLElement {
    const {axes} = sweep.summary, {data, measures} = sweep, isOff = (k: number, value: number | null) => "at_least" in measures[k] && (value === null || limitsOf(measures[k]).length > 0 && !isWithin(measures[k], value));
    const known = (value: number): Cell => (Number.isNaN(value) ? null : plainNumber(value));
    const reason = (row: number) => {
        const k = sweep.at(row);
        return data.rows.end[k] ? data.reasons[data.rows.item[k]] || ["", "too many steps or iterations", "did not converge"][data.rows.end[k]] : "limits";
    };
    return table({name, isStacked: true, columns: [{name: "item"},
        ...axes.map(({name: axis, unit}, a): Column => ({name: columnName(axis, unit), label: headed(axis, unit), isNumber: true, show: (value) => [sweep.levelText(a, value as number)]})),
        ...measures.map((one, k): Column => ({name: columnName(one.name, one.unit), label: headed(one.name, one.unit), isNumber: true,
            show: (value) => [h("span", {class: isOff(k, value as number | null) ? "bad" : ""}, textOn(one, value as number | null), isOff(k, value as number | null) ? " ✗" : "")]})),
        ...(hasReason ? [{name: "reason", class: "reason"}] : [])],
        rows: rows.map((row) => [data.rows.item[sweep.at(row)], ...axes.map((_, a) => known(sweep.axisValues[a][sweep.at(row)])), ...measures.map((_, k) => known(sweep.measured(k, row))), ...(hasReason ? [reason(row)] : [])])});
}

const isWithin = ({at_least: low, at_most: high}: {at_least?: number | null; at_most?: number | null}, value: number) => value >= (low ?? -Infinity) && value <= (high ?? Infinity);

export function showFailed(host: Element, sweep: Sweep) {
    const {failed} = sweep.data, count = sweep.summary.all.items - sweep.summary.all.passed;
    if (failed.length) section(host, "failed", "Failed items", failed.length < count ? `the first ${failed.length} of ${count}` : `${count}`).append(itemTable("failed items", sweep, failed, true));
}
