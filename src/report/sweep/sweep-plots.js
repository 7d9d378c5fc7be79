"use strict";
// Histograms, normal plots, scatter plots and envelopes of a sweep. In a plot, dragging zooms and a double click resets.

/// Adds a figure with a title (HTML). Returns the element for its plot.
function figure(host, title) {
    const node = element(host, "figure");
    element(node, "figcaption", "", `<span class="title">${title}</span>`);
    return element(node, "div", "plot");
}

const axisText = (unit) => (v) => quantity(Number(v.toPrecision(10)), unit, true);

/// Creates a plot with the common options. `x`, `y`: axis titles as HTML. `yTicker`: replaces the ticks of the y axis. `drawBackground` draws below
/// the curves. `range`: of the y axis.
function plot(host, rows, labels, {x, y, xUnit = "", yUnit = "", yTicker, series = {}, drawBackground, range}) {
    const chart = new Dygraph(host, rows, {
        labels, series, xlabel: x, ylabel: y, xLabelHeight: 16, yLabelWidth: 16, legend: "never", highlightCircleSize: 0, xRangePad: 6, yRangePad: 4,
        gridLineColor: themeColour("grid"), axisLineColor: themeColour("axis"), underlayCallback: drawBackground, ...(range ? {valueRange: range} : {}),
        axes: {x: {axisLabelFontSize: 11, axisLabelFormatter: axisText(xUnit), axisLabelWidth: 64, pixelsPerLabel: 80},
               y: {axisLabelFontSize: 11, axisLabelWidth: 60, ...(yTicker ? {ticker: yTicker} : {axisLabelFormatter: axisText(yUnit)})}},
    });
    charts.push(chart);
    return chart;
}

/// Draws the limits of a measure as vertical (true) or horizontal lines.
function limitLines(context, area, chart, measure, vertical) {
    for (const limit of [measures[measure].at_least, measures[measure].at_most]) {
        if (limit === null || limit === undefined) continue;
        const at = vertical ? chart.toDomXCoord(limit) : chart.toDomYCoord(limit);
        context.save();
        context.strokeStyle = themeColour("ink"), context.lineWidth = 1, context.setLineDash([5, 3]);
        context.beginPath();
        if (vertical) context.moveTo(at, area.y), context.lineTo(at, area.y + area.h);
        else context.moveTo(area.x, at), context.lineTo(area.x + area.w, at);
        context.stroke(), context.restore();
    }
}

/// Draws a line between two points in data coordinates.
function line(context, chart, [x0, y0], [x1, y1], color) {
    context.beginPath(), context.strokeStyle = color, context.lineWidth = 1;
    context.moveTo(...chart.toDomCoords(x0, y0)), context.lineTo(...chart.toDomCoords(x1, y1)), context.stroke();
}

/// Rows for dygraphs: one row per point, with its x, and its y in the column of its group; the columns of the other groups are null. `count`: number
/// of groups.
function columnsOf(xs, ys, groups, count) {
    const rows = xs.map((x, k) => { const row = Array(count + 1).fill(null); row[0] = x, row[groups[k] + 1] = ys[k]; return row; });
    return rows.filter((row, k) => row[0] !== null && ys[k] !== null).sort((a, b) => a[0] - b[0]);
}

// Labels of the groups, which must be unique, and the dygraphs options with which groups are drawn as points.
const groupLabels = () => grouping().groups.map((name, k) => (grouping().groups.indexOf(name) === k ? name : `${name} (${k + 1})`));
const pointSeries = (size) => Object.fromEntries(groupLabels().map((label, k) => [label, {color: groupColour(k), strokeWidth: 0, drawPoints: true, pointSize: size}]));

function showHistogram(host, measure) {
    const histogram = data.histograms[measure][state.grouping];
    if (!histogram) return;
    const {name, unit} = measures[measure], {from, width, counts, below, above} = histogram, several = counts.length > 1;
    const sums = counts.map((all) => all.reduce((a, b) => a + b, 0) || 1);
    const height = (k, bin) => (several ? 100 * counts[k][bin] / sums[k] : counts[k][bin]);
    const rows = counts[0].map((_, bin) => [from + bin * width, ...counts.map((_, k) => height(k, bin))]);
    rows.unshift([from - 1e-9 * width, ...counts.map(() => 0)]);
    rows.push([from + counts[0].length * width, ...counts.map(() => 0)]);
    const far = below + above ? `; ${below + above} outliers are counted in the outer bins` : "";
    const series = Object.fromEntries(groupLabels().map((label, k) => [label, {color: groupColour(k), stepPlot: true, fillGraph: true, strokeWidth: 1.2}]));
    plot(figure(host, `${escaped(name)}: histogram <span class="unit">${far}</span>`), rows, [name, ...groupLabels()],
         {x: escaped(name), y: several ? "% of group" : "items", xUnit: unit, series, drawBackground: (context, area, chart) => limitLines(context, area, chart, measure, true)});
}

// Ticks of a normal plot: standard normal score and cumulative probability.
const PROBABILITIES = [[-4.2649, "0.001 %"], [-3.0902, "0.1 %"], [-2.3263, "1 %"], [-1.6449, "5 %"], [-0.6745, "25 %"], [0, "50 %"], [0.6745, "75 %"], [1.6449, "95 %"], [2.3263, "99 %"],
                       [3.0902, "99.9 %"], [4.2649, "99.999 %"]];

function showNormalPlot(host, measure) {
    const all = data.normal_plots[measure][state.grouping], {name, unit} = measures[measure];
    const xs = all.flatMap(({values}) => values), ys = all.flatMap(({scores}) => scores), groups = all.flatMap(({values}, k) => values.map(() => k));
    if (xs.length < 3) return;
    const {mean, sigma} = table.all.measures[measure], single = all.length === 1 && sigma.value > 0;
    const ticker = (lo, hi) => PROBABILITIES.filter(([v]) => v >= lo && v <= hi).map(([v, label]) => ({v, label}));
    plot(figure(host, `${escaped(name)}: normal plot <span class="unit">a straight line indicates a normal distribution</span>`), columnsOf(xs, ys, groups, all.length), [name, ...groupLabels()],
         {x: escaped(name), y: "cumulative fraction", xUnit: unit, yTicker: ticker, series: pointSeries(1.6), drawBackground: (context, area, chart) => {
             if (single) line(context, chart, [mean.value - 6 * sigma.value, -6], [mean.value + 6 * sigma.value, 6], themeColour("axis"));
             limitLines(context, area, chart, measure, true);
         }});
}

/// A measure over one factor; see factor_document() in sweep_page.cpp.
function showScatter(host, measure, factor) {
    const {name, unit} = measures[measure], xs = factor.values || varied(factor.axis, data.points), ys = measured(measure, data.points);
    const rows = columnsOf(xs, ys, groupsOf(data.points), grouping().groups.length);
    if (!rows.length) return;
    const part = factor.quantity ? `, ${factor.quantity.replace(/_(.)/, "<sub>$1</sub>")}` : "";
    const thinned = data.points.length < table.finished ? `; ${data.points.length} of ${table.finished} items` : "";
    plot(figure(host, `${escaped(name)} over ${escaped(factor.name)}${part} <span class="unit">${percent(factor.fraction)} % of its variance${thinned}</span>`), rows, [factor.name, ...groupLabels()],
         {x: escaped(factor.name) + part, y: escaped(name), xUnit: factor.unit, yUnit: unit, series: pointSeries(1.5), drawBackground: (context, area, chart) => limitLines(context, area, chart, measure, false)});
}

/// The median over items of a probe, with bands from 5 to 95 % and from minimum to maximum.
function showEnvelope(host, trace) {
    const {name, times, items, medians, every} = trace, groups = medians[state.grouping], several = groups.length > 1;
    const note = `${items < table.finished ? `${items} of ${table.finished} items: ` : ""}median, 5 to 95 %, min to max${every ? "; not every sample is shown" : ""}`;
    const box = figure(host, `${escaped(name)} <span class="unit">${note}</span>`);
    const labels = several ? groupLabels() : ["median"], columns = several ? groups : [trace.median];
    const rows = times.map((t, k) => [t, ...columns.map((column) => column[k])]);
    const known = [...trace.min, ...trace.max].filter((v) => v !== null), low = Math.min(...known), high = Math.max(...known), margin = 0.05 * (high - low || 1);
    const band = (context, chart, from, to, alpha) => {
        context.beginPath();
        times.forEach((t, k) => context.lineTo(...chart.toDomCoords(t, to[k])));
        [...times].reverse().forEach((t, k) => context.lineTo(...chart.toDomCoords(t, from[times.length - 1 - k])));
        context.globalAlpha = alpha, context.fillStyle = colour(0), context.fill(), context.globalAlpha = 1;
    };
    plot(box, rows, ["time", ...labels], {x: "time", y: escaped(name), xUnit: "s", range: [low - margin, high + margin],
         series: Object.fromEntries(labels.map((label, k) => [label, {color: several ? groupColour(k) : colour(0), strokeWidth: 1.6}])),
         drawBackground: (context, area, chart) => { band(context, chart, trace.min, trace.max, 0.14); band(context, chart, trace.low, trace.high, 0.28); }});
}

/// Shows the legend of the groups of the selected grouping, if there are several.
function showKey() {
    const {groups} = grouping();
    document.getElementById("key").innerHTML = groups.length === 1 ? "" : groups.map((name, k) => `<span><span class="chip" style="background: ${groupColour(k)}"></span>${escaped(name)}</span>`).join("");
}
