// Figures of a sweep with random items: histogram, normal plot, scatter plots over the factors that matter, rasters and envelopes of traces.

import {decoded, numbersOf} from "../base/arrays";
import {resolved} from "../base/colours";
import {expose} from "../base/panels";
import type {EnvelopeData, Factor, SweepRasterData} from "../data/sweep";
import {Axis, textOn} from "../panels/axis";
import {Curve, seriesStyle} from "../panels/curves";
import {RasterPanel, Row, rasterHeight} from "../panels/raster-panel";
import {Spikes} from "../panels/signals";
import {XyPanel} from "../panels/xy-panel";
import type {Area} from "../plot/panel";
import type {Pen} from "../plot/pen";
import {View} from "../plot/view";
import {Sweep, limitsOf, percent} from "./sweep-data";

/// The selected measure and grouping.
export interface Choice { measure: number; grouping: number }

const groupNames = (sweep: Sweep, {grouping}: Choice) => sweep.data.groupings[grouping].groups.map((name, k, all) => (all.indexOf(name) === k ? name : `${name} (${k + 1})`));

export function showHistogram(host: Element, sweep: Sweep, choice: Choice) {
    const histogram = sweep.data.histograms[choice.measure][choice.grouping];
    if (!histogram) return;
    const {from, width, counts, below, above} = histogram, xAxis = sweep.measureAxis(choice.measure), names = groupNames(sweep, choice), hasGroups = counts.length > 1;
    const edges = Array.from({length: counts[0].length + 1}, (_, k) => from + k * width);
    const curves = counts.map((all, k): Curve => {
        const sum = all.reduce((a, b) => a + b, 0) || 1;
        return {name: names[k], label: hasGroups ? [names[k]] : [], ...seriesStyle(k, "steps"), style: "steps", x: edges, y: hasGroups ? all.map((n) => 100 * n / sum) : all};
    });
    expose(new XyPanel({host, name: "histogram", title: `${xAxis.name}: histogram`, note: below + above ? `${below + above} outliers are counted in the outer bins` : "", about: `histogram of ${xAxis.name}`, height: 230,
                        xAxis, yAxis: {name: hasGroups ? "part of the group" : "items", unit: hasGroups ? "%" : ""}, curves, levels: limitsOf(sweep.measures[choice.measure]).map((value) => ({value, isVertical: true}))}));
}

// Ticks of a normal plot: standard normal score and cumulative probability.
const PROBABILITIES: [number, string][] = [[-4.2649, "0.001 %"], [-3.0902, "0.1 %"], [-2.3263, "1 %"], [-1.6449, "5 %"], [-0.6745, "25 %"], [0, "50 %"], [0.6745, "75 %"], [1.6449, "95 %"],
                                           [2.3263, "99 %"], [3.0902, "99.9 %"], [4.2649, "99.999 %"]];

export function showNormalPlot(host: Element, sweep: Sweep, choice: Choice) {
    const plots = sweep.data.normal_plots[choice.measure][choice.grouping], xAxis = sweep.measureAxis(choice.measure), names = groupNames(sweep, choice);
    const curves = plots.map(({values, scores}, k): Curve => ({name: names[k], label: [plots.length > 1 ? names[k] : "items"], ...seriesStyle(k, "points"), style: "points", x: numbersOf(values), y: numbersOf(scores)}));
    if (curves.reduce((sum, {x}) => sum + x.length, 0) < 3) return;
    const {mean, sigma} = sweep.summary.all.measures[choice.measure];
    if (curves.length === 1 && mean.value !== null && sigma.value)
        curves.push({name: "normal distribution", label: ["normal distribution"], colour: "var(--axis)", width: 1, style: "line", isReference: true, x: [mean.value - 6 * sigma.value, mean.value + 6 * sigma.value], y: [-6, 6]});
    expose(new XyPanel({host, name: "normal plot", title: `${xAxis.name}: normal plot`, note: "a straight line indicates a normal distribution", about: `normal plot of ${xAxis.name}`, height: 230, xAxis,
                        yAxis: {name: "cumulative fraction", unit: "", marks: PROBABILITIES}, curves, levels: limitsOf(sweep.measures[choice.measure]).map((value) => ({value, isVertical: true}))}));
}

/// The measure over one factor that explains a part of its variance.
export function showFactor(host: Element, sweep: Sweep, choice: Choice, factor: Factor) {
    const {points, rows} = sweep.data, own = sweep.measureAxis(choice.measure), name = `${own.name} over ${factor.name}${factor.quantity ? `, ${factor.quantity}` : ""}`;
    const values = factor.values ? numbersOf(factor.values) : points.map((row) => sweep.axisValues[factor.axis!][sweep.at(row)]);
    const xAxis: Axis = {...(factor.axis !== undefined ? sweep.axis(factor.axis) : {unit: factor.unit}), name: factor.name + (factor.quantity ? `, ${factor.quantity}` : "")};
    const groups = groupNames(sweep, choice).map((group, k): Curve => {
        const chosen = points.map((row, i) => ({row, i})).filter(({row}) => rows.groups[choice.grouping][sweep.at(row)] === k);
        return {name: group, label: [group], ...seriesStyle(k, "points"), style: "points", x: chosen.map(({i}) => values[i]), y: chosen.map(({row}) => sweep.measured(choice.measure, row))};
    });
    if (!groups.some(({x}) => x.length)) return;
    if (groups.length === 1) groups[0].label = [];
    const part = points.length < sweep.summary.finished ? `; ${points.length} of ${sweep.summary.finished} items` : "";
    expose(new XyPanel({host, name, title: name, note: `${percent(factor.fraction)} % of its variance${part}`, about: name, height: 230, xAxis, yAxis: own, curves: groups, levels: limitsOf(sweep.measures[choice.measure]).map((value) => ({value}))}));
}

/// A raster of items. Failed items have a mark at the left.
class ItemRaster extends RasterPanel<Row & {hasFailed: boolean}> {
    protected paintMargins(pen: Pen, {x, y, h: height}: Area) {
        pen.fillStyle = resolved("var(--bad)");
        const row = height / this.rows.length;
        this.rows.forEach(({hasFailed}, k) => hasFailed && pen.fillRect(x + 1, y + k * row, 4, Math.max(1, row - 1)));
    }
}

/// The spikes of many items, sorted by the selected measure; the smallest is at the bottom.
export function showRaster(host: Element, sweep: Sweep, choice: Choice, {name, rows, counts, times}: SweepRasterData) {
    const all = Float64Array.from(decoded<Float32Array>(times)), names = groupNames(sweep, choice), {data, summary} = sweep, measure = sweep.measures[choice.measure];
    let from = 0;
    const items = rows.map((row, k) => {
        const group = data.rows.groups[choice.grouping][sweep.at(row)], value = sweep.measured(choice.measure, row), hasFailed = !data.rows.passes[sweep.at(row)], item = data.rows.item[sweep.at(row)];
        return {value, series: names[group], colour: sweep.groupColour(group), hasFailed, spikes: new Spikes(all.slice(from, (from += counts[k]))), label: String(item),
                about: `item ${item}${hasFailed ? " (failed)" : ""}${measure ? `, ${measure.name} ${textOn(measure, value)}` : ""}`};
    }).sort((a, b) => (Number.isNaN(b.value) ? -Infinity : b.value) - (Number.isNaN(a.value) ? -Infinity : a.value));
    const end = all.reduce((last, t) => Math.max(last, t), 0) * 1.02 || 1, view = new View(), shown = rows.length < summary.finished ? `${rows.length} of ${summary.finished} items, ` : "";
    view.setLimits({begin: 0, end, smallest: 1e-6});
    const panel = new ItemRaster({host, name: `${name} spikes`, title: [`${name}: spikes (${shown}sorted by ${measure?.name ?? "item"}, smallest at the bottom; failed items are marked at the left)`], about: `spikes of ${rows.length} items`,
                                  height: Math.min(460, rasterHeight(items.length)), phases: [], rows: items, isBottom: true,
                                  series: names.map((one, k) => ({name: one, label: [names.length > 1 ? one : "spikes"], colour: sweep.groupColour(k), width: 3}))});
    view.add(panel);
    expose(panel);
}

/// The median of a trace over the items, with areas from 5 to 95 % and from the smallest to the largest value.
export function showEnvelope(host: Element, sweep: Sweep, {grouping}: Choice, trace: EnvelopeData) {
    const medians = trace.medians[grouping], names = sweep.data.groupings[grouping].groups, x = numbersOf(trace.times), isGrouped = medians.length > 1;
    const bands = [{low: numbersOf(trace.min), high: numbersOf(trace.max)}, {low: numbersOf(trace.low), high: numbersOf(trace.high)}];
    const curves: Curve[] = [{name: "median", label: ["median"], ...seriesStyle(0, "line"), style: "line", x, y: numbersOf(trace.median), bands},
                             ...(isGrouped ? medians.map((one, k): Curve => ({name: names[k], label: [names[k]], ...seriesStyle(k, "line"), style: "line", x, y: numbersOf(one)})) : [])];
    if (isGrouped) curves[0].colour = "var(--level)";
    const note = `${trace.items < sweep.summary.finished ? `${trace.items} of ${sweep.summary.finished} items: ` : ""}median, 5 to 95 %, smallest to largest${trace.every ? "; not every sample is shown" : ""}`;
    expose(new XyPanel({host, name: trace.name, title: trace.name, note, about: `${trace.name}: ${note}`, height: 220, xAxis: {name: "time", unit: "s"}, yAxis: {name: trace.name, unit: trace.unit ?? ""}, curves}));
}
