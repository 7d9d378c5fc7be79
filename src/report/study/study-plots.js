"use strict";
// Figures of curves, points and rasters. In a figure, dragging zooms and a double click resets.

const colour = (k) => getComputedStyle(document.documentElement).getPropertyValue(`--series-${k % 8}`).trim();
/// A series may name the number of its colour, so that two series share one.
const colourOf = (series, k) => colour(series[k].colour ?? k);
// colour(k): of series k, from 0. themeColour(name): of the style sheet.
const themeColour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

function element(host, tag, kind = "", html = "") {
    const node = document.createElement(tag);
    if (kind) node.className = kind;
    node.innerHTML = html;
    return host.appendChild(node);
}

/// The data for dygraphs: one column per series, null where a series has no value, and one row per distinct x. If a series has several points at
/// one x, there is a row for each of them. `series` have styles line, points, raster (marks at a height of their own; the first of `height` series
/// is the highest) or path (null here, since drawPath() draws it).
function rowsOf(series, height) {
    const at = new Map();
    series.forEach(({x, y, style}, s) => x.forEach((t, k) => {
        if (t === null) return;
        if (!at.has(t)) at.set(t, []);
        const rows = at.get(t);
        let row = rows.find((one) => one[s + 1] === null);
        if (!row) rows.push(row = [t, ...series.map(() => null)]);
        row[s + 1] = style === "raster" ? height - s : style === "path" ? null : y[k];
    }));
    return [...at.values()].flat().sort((a, b) => a[0] - b[0]);
}

/// A number on an axis as text: up to six digits, with an exponent if it is very large or small.
function shortest(v) {
    const number = Number(v.toPrecision(6)), size = Math.abs(number);
    return size !== 0 && (size < 1e-3 || size >= 1e6) ? number.toExponential().replace("e+", "e") : String(number);
}

/// Ticks of a logarithmic axis from lo to hi. The plotted values are log10 of the data; the labels show the data. Dygraphs' own logarithmic scale
/// is not used, because it does not suit x axes.
const logTicks = (lo, hi) => {
    const ticks = [], mantissas = hi - lo > 5 ? [1] : [1, 2, 5];
    for (let decade = Math.floor(lo); decade <= Math.ceil(hi); ++decade)
        for (const m of mantissas) {
            const v = decade + Math.log10(m);
            if (v >= lo - 1e-9 && v <= hi + 1e-9) ticks.push({v, label: shortest(10 ** v)});
        }
    return ticks;
};

function showPlot(host, plot) {
    const figure = element(host, "figure");
    element(figure, "figcaption", "", escaped(plot.title));
    if (plot.published) element(figure, "p", "printed", `Published: ${escaped(plot.published)}`);
    element(figure, "div", "key", plot.series.map(({name, colour: shared}, k) => name === "" && shared !== undefined ? "" : `<span><span class="chip" style="background: ${colourOf(plot.series, k)}"></span>${escaped(name)}</span>`).join(""));
    const raster = plot.series.every(({style}) => style === "raster");
    const series = plot.series.map((one) => ({...one, x: plot.log_x ? one.x.map(Math.log10) : one.x, y: plot.log_y ? one.y.map(Math.log10) : one.y}));
    const paths = series.map((one, k) => ({...one, colour: colourOf(plot.series, k)})).filter(({style}) => style === "path");
    const rows = rowsOf(series, series.length);
    if (!rows.length) return;
    const axis = (label, log, width) => ({axisLabelFontSize: 11, axisLabelWidth: width, ...(log ? {ticker: logTicks} : {axisLabelFormatter: shortest})});
    // Labels must be unique, so a repeated name gets its number.
    const labels = plot.series.map(({name}, k) => `${name || "computed"}${plot.series.findIndex((one) => one.name === name) === k ? "" : ` (${k + 1})`}`);
    const chart = new Dygraph(element(figure, "div", "plot"), rows, {
        labels: [plot.x, ...labels],
        series: Object.fromEntries(plot.series.map(({style}, k) => [labels[k], {
            color: colourOf(plot.series, k), strokeWidth: style === "line" ? 1.6 : 0, drawPoints: style !== "line", pointSize: style === "raster" ? 4 : 3, connectSeparatedPoints: true,
            ...(style === "raster" ? {drawPointCallback: drawTick} : {}),
        }])),
        axes: {x: axis(plot.x, plot.log_x, 60), y: {...axis(plot.y, plot.log_y, 56), drawAxis: !raster}},
        ...(raster ? {valueRange: [0.3, series.length + 0.7]} : {}),
        ...(paths.length ? {valueRange: span(paths.flatMap(({y}) => y)), underlayCallback: (context, area, chart) => paths.forEach((one) => drawPath(chart, context, one))} : {}),
        xlabel: plot.x, ylabel: plot.y || undefined, xLabelHeight: 16, yLabelWidth: 16,
        xRangePad: raster ? 14 : 6, yRangePad: 6, legend: "never", highlightCircleSize: 0,
        gridLineColor: themeColour("grid"), axisLineColor: themeColour("axis"),
    });
    (window.charts ||= []).push(chart);
}

/// [min, max] of values with a margin; null is ignored.
function span(values) {
    const known = values.filter((v) => v !== null), min = Math.min(...known), max = Math.max(...known), margin = 0.06 * (max - min);
    return [min - margin, max + margin];
}

/// Draws a line through points in their order, which dygraphs cannot do if x is not ascending. Null interrupts the line.
function drawPath(chart, context, {x, y, colour}) {
    context.beginPath();
    context.strokeStyle = colour, context.lineWidth = 1.4;
    let penDown = false;
    x.forEach((t, k) => {
        if (t === null || y[k] === null) return void (penDown = false);
        const [left, top] = chart.toDomCoords(t, y[k]);
        if (penDown) context.lineTo(left, top); else context.moveTo(left, top);
        penDown = true;
    });
    context.stroke();
}

/// Draws a spike of a raster as a vertical stroke.
function drawTick(chart, name, context, x, y, color) {
    context.beginPath();
    context.strokeStyle = color, context.lineWidth = 1.2;
    context.moveTo(x, y - 9), context.lineTo(x, y + 9);
    context.stroke();
}
