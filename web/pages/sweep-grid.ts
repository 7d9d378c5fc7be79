// The page of a sweep over a grid, which may have random items at each point: a measure over two axes as heat map and lines, the effect of every axis, and tables.

import {numbersOf} from "../base/arrays";
import {seriesColour} from "../base/colours";
import {Child, chooser, fill, h} from "../base/dom";
import {expose} from "../base/panels";
import type {Effect} from "../data/sweep";
import {textOn} from "../panels/axis";
import {fractionBar} from "../panels/bars";
import {Curve} from "../panels/curves";
import {HeatMap} from "../panels/heat-map";
import {table} from "../panels/table";
import {extentOf, withMargins} from "../panels/time-panel";
import {XyPanel} from "../panels/xy-panel";
import {section} from "../shell";
import {Sweep, limitsOf, percent} from "./sweep-data";

const MAX_LINES = 8;

/// The axes of the figures: x and y, and for each other axis the value that it has, or null for the mean over it.
export interface GridChoice { x: number; y: number; fixed: (number | null)[] }

const effectsOf = (sweep: Sweep, measure: number): Effect[] => (sweep.isGrid ? sweep.data.grids![measure]?.effects || [] : sweep.effectsOfGrid(measure));

/// Axes with several values, that with the largest effect on the measure first.
export function variedAxes(sweep: Sweep, measure: number): number[] {
    const byEffect = effectsOf(sweep, measure).map(({axis}) => axis), all = sweep.summary.axes.map((_, a) => a).filter((a) => sweep.levels(a).length > 1);
    return [...byEffect, ...all.filter((a) => !byEffect.includes(a) && (sweep.isGrid || sweep.summary.axes[a].is_listed))];
}

/// Selectors of the axes. `change` is called after each choice.
export function axisChoosers(host: Element, sweep: Sweep, measure: number, choice: GridChoice, change: () => void): void {
    const axes = variedAxes(sweep, measure).sort((a, b) => a - b), names = axes.map((a) => sweep.summary.axes[a].name);
    if (axes.length < 2) return void fill(host);
    const choose = (own: "x" | "y", other: "x" | "y") => (k: number) => {
        if (choice[other] === axes[k]) choice[other] = choice[own];
        choice[own] = axes[k];
        change();
    };
    const others = !sweep.isComplete ? [] : axes.filter((a) => a !== choice.x && a !== choice.y).map((a) => {
        const levels = sweep.levels(a), selected = choice.fixed[a] === null ? 0 : 1 + levels.indexOf(choice.fixed[a]!);
        return chooser(sweep.summary.axes[a].name, ["mean", ...levels.map((value) => sweep.levelText(a, value))], selected, (k) => { choice.fixed[a] = k ? levels[k - 1] : null; change(); });
    });
    fill(host, chooser("Across", names, axes.indexOf(choice.x), choose("x", "y")), chooser("Up", names, axes.indexOf(choice.y), choose("y", "x")), ...others);
}

/// "mean over sa1.V_th; sa1.t_ref 5 ms", for the axes that a figure does not show.
function othersText(sweep: Sweep, {x, y, fixed}: GridChoice): string {
    const others = sweep.summary.axes.map((_, a) => a).filter((a) => a !== x && a !== y && sweep.levels(a).length > 1), means = others.filter((a) => fixed[a] === null || !sweep.isComplete);
    return [...(means.length ? [`mean over ${means.map((a) => sweep.summary.axes[a].name).join(", ")}`] : []), ...others.filter((a) => !means.includes(a)).map((a) => `${sweep.summary.axes[a].name} ${sweep.levelText(a, fixed[a]!)}`)].join("; ");
}

const evenlySpaced = (count: number, max: number) => (count <= max ? [...Array(count).keys()] : [...Array(max).keys()].map((k) => Math.round(k * (count - 1) / (max - 1))));
const known = (values: (number | null)[]) => values.map((v) => v ?? NaN);

/// The figures of a measure: heat map and lines over the two chosen axes, or a line over a single axis.
export function showGridFigures(host: Element, sweep: Sweep, measure: number, choice: GridChoice): void {
    const own = sweep.measureAxis(measure), axes = variedAxes(sweep, measure), levels = limitsOf(sweep.measures[measure]).map((value) => ({value}));
    const lines = (x: number, xs: number[], curves: {name: string; ys: number[]}[]) => {
        const xAxis = sweep.axis(x), name = `${own.name} over ${xAxis.name}`;
        expose(new XyPanel({host, name, title: name, note: othersText(sweep, axes.length > 1 ? choice : {...choice, x, y: x}), about: name, height: 230, xAxis, yAxis: own, levels,
                            curves: curves.map(({name: one, ys}, k): Curve => ({name: one, label: [one], colour: seriesColour(k), style: "line", hasPoints: true, x: xs, y: ys}))}));
    };
    if (!effectsOf(sweep, measure).length) return void host.append(h("p", {class: "note"}, `${own.name} is constant over the grid.`));
    if (axes.length < 2) {
        const {axis, values, means} = effectsOf(sweep, measure)[0];
        return lines(axis, Array.from(numbersOf(values)), [{name: own.name, ys: Array.from(numbersOf(means))}]);
    }
    const {x, y} = choice, {xs, ys, means} = sweep.meansOver(measure, x, y, choice.fixed);
    if (!xs.length) return void host.append(h("p", {class: "note"}, "The grid is too large for the page to hold this pair of axes."));
    const name = `${own.name}: heat map`, axisWord = (axis: number, value: number) => `${sweep.summary.axes[axis].name} ${sweep.levelText(axis, value)}`;
    expose(new HeatMap({host, name, title: `${own.name} over ${sweep.axis(x).name} and ${sweep.axis(y).name}`, note: h("small", {}, othersText(sweep, choice)), about: name, height: 230, quantity: own,
                        xAxis: sweep.axis(x), yAxis: sweep.axis(y), xs, ys, values: means}));
    lines(x, xs, evenlySpaced(ys.length, MAX_LINES).map((j) => ({name: axisWord(y, ys[j]), ys: known(means.map((column) => column[j]))})));
    lines(y, ys, evenlySpaced(xs.length, MAX_LINES).map((i) => ({name: axisWord(x, xs[i]), ys: known(means[i])})));
}

/// The mean of the measure at each value of every axis; all plots have one scale.
export function showMainEffects(host: Element, sweep: Sweep, measure: number) {
    const effects = effectsOf(sweep, measure), yAxis = sweep.measureAxis(measure);
    if (effects.length < 2) return;
    const range = withMargins(extentOf([], effects.flatMap(({means}) => Array.from(numbersOf(means)))));
    for (const {axis, fraction, values, means} of effects) {
        const xAxis = sweep.axis(axis), name = `effect of ${xAxis.name}`;
        expose(new XyPanel({host, name, title: xAxis.name, note: `${percent(fraction)} % of the variance`, about: `${yAxis.name}: ${name}`, height: 130, xAxis, yAxis, range,
                            curves: [{name: yAxis.name, label: [], colour: seriesColour(0), style: "line", hasPoints: true, x: numbersOf(values), y: numbersOf(means)}]}));
    }
}

/// The effect of every axis on every measure.
export function showEffects(host: Element, sweep: Sweep) {
    const rows: (string | number | null)[][] = [], shown: {measure: number; axis: number}[] = [];
    sweep.data.grids!.forEach(({effects}, measure) => {
        const add = (axis: number, name: string, fraction: number | null, ends: (number | null)[]) => { rows.push([sweep.measures[measure].name, name, fraction, null, ...ends]); shown.push({measure, axis}); };
        if (!effects.length) add(-1, "constant", null, [null, null, null, null]);
        for (const {axis, fraction, values, means} of effects) {
            const [v, m] = [numbersOf(values), numbersOf(means)];
            add(axis, sweep.summary.axes[axis].name, fraction, [v[0], m[0], v[v.length - 1], m[m.length - 1]]);
        }
        const rest = 1 - effects.reduce((sum, {fraction}) => sum + fraction, 0);
        if (effects.length > 1 && rest >= 0.0005) add(-1, "interactions", rest, [null, null, null, null]);
    });
    if (!rows.length) return;
    const end = (show: (k: number, value: number) => string) => (value: unknown, k: number): Child[] => [shown[k].axis < 0 ? "" : show(k, value as number)];
    const level = end((k, value) => sweep.levelText(shown[k].axis, value)), mean = end((k, value) => textOn(sweep.measures[shown[k].measure], value));
    section(host, "influences", "Effect of each axis", "share of the variance over the grid that is explained by the means at the axis values; means at the first and last value").append(table({
        name: "effects", isStacked: true, rows, columns: [{name: "measure"}, {name: "axis"}, {name: "variance", isNumber: true, show: (value) => [value === null ? "" : `${percent(value as number)} %`]},
            {name: "bar", label: [""], class: "bar-cell", show: (_, k) => [rows[k][2] === null ? "" : fractionBar({value: rows[k][2] as number, low: null, high: null})]},
            {name: "from", isNumber: true, show: level}, {name: "mean there", isNumber: true, show: mean}, {name: "to", isNumber: true, show: level}, {name: "mean at the end", label: ["mean there"], isNumber: true, show: mean}]}));
}

/// Range and mean of each measure, with the points of the smallest and largest values. data.extremes has the rows with the smallest values of a
/// measure, then as many (or one fewer) with the largest.
export function showGridMeasures(host: Element, sweep: Sweep) {
    const rows = sweep.summary.all.measures.map((one, k) => {
        const extremes = sweep.data.extremes[k], at = (row: number | undefined) => (one.min === one.max ? "all points" : row === undefined ? "–" : sweep.pointText(row));
        return [one.name, one.items, one.min, at(extremes[0]), one.max, at(extremes[Math.ceil(extremes.length / 2)] ?? extremes[0]), one.mean.value];
    });
    const show = (value: unknown, k: number): Child[] => [textOn(sweep.measures[k], value as number | null)];
    host.append(table({name: "measures", isStacked: true, rows, columns: [{name: "measure"}, {name: "items", isNumber: true}, {name: "min", isNumber: true, show}, {name: "at (min)", label: ["at"], class: "wide"},
        {name: "max", isNumber: true, show}, {name: "at (max)", label: ["at"], class: "wide"}, {name: "mean", isNumber: true, show}]}));
}

