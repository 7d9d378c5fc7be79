"use strict";
// The page of a sweep over a grid without random parameters: the effect of each axis, in tables, line plots and heat maps.

const MAX_LINES = 10;
const HEAT = {left: 76, right: 10, top: 4, bottom: 40};  // margins of a heat map, pixels

const axisName = (axis) => table.axes[axis].name;
// The text of an axis value; an axis with words, such as corners, has indices as values.
const levelText = (axis, value) => (table.axes[axis].words ? table.axes[axis].words[value] ?? "–" : quantity(value, table.axes[axis].unit, true));
const measureText = (measure, value) => quantity(value, measures[measure].unit, true);

/// The axis values of a row of the sweep as text: "press.F_max 2 N, sa1.f_B 20 Hz".
const pointText = (row) => table.axes.map((axis, a) => `${axis.name} ${levelText(a, data.rows.axes[a][rowNumber.get(row)])}`).join(", ");

function startGrid(host) {
    const note = `${openingText()}; a grid of ${table.axes.map(({name}) => name).join(" by ")}, without random parameters`;
    const node = section(host, "measures", "Measures", note);
    if (!table.finished) return;
    if (table.all.passed < table.all.items) showGridYields(node);
    showGridMeasures(node);
    showEffects(host);
    showGridPoints(host);
}

function showGridYields(host) {
    const {all} = table, limited = measures.some((m) => "at_least" in m);
    const line = (name, limits, {value}) => textCell(name) + textCell(limits) + cell(`${Math.round(value * all.items)} of ${all.items}`) + cell(`${percent(value)} %`);
    const rows = [line(limited ? "all limits" : "completed", "", all.yield)];
    all.measures.forEach((one, k) => one.yield && rows.push(line(one.name, limitsText(measures[k]), one.yield)));
    showTable(host, ["", "limits", "passed", ""], rows);
}

/// The table of measures. data.extremes[k] has the rows with the smallest values of measure k, then as many (or one fewer) with the largest.
function showGridMeasures(host) {
    const rows = table.all.measures.map((one, k) => {
        const rows = data.extremes[k], at = (row) => (one.min === one.max ? "all points" : row === undefined ? "–" : pointText(row));
        return `<th scope="row">${escaped(one.name)}</th>` + cell(one.items) + cell(measureText(k, one.min)) + textCell(at(rows[0])) + cell(measureText(k, one.max)) +
            textCell(at(rows[Math.ceil(rows.length / 2)] ?? rows[0])) + cell(measureText(k, one.mean.value));
    });
    showTable(host, ["", "items", "min", "at", "max", "at", "mean"], rows);
}

/// The table of the effect of every axis on every measure; see data.grids in sweep_page.cpp.
function showEffects(host) {
    const rows = [];
    data.grids.forEach(({effects}, m) => {
        const first = `<th scope="row">${escaped(measures[m].name)}</th>`;
        if (!effects.length) rows.push(`${first}<td colspan="5">constant</td>`);
        effects.forEach(({axis, fraction, values, means}, k) => {
            const end = (n) => cell(`${escaped(levelText(axis, values.at(n)))} <span class="range">${measureText(m, means.at(n))}</span>`);
            rows.push((k ? textCell("") : first) + textCell(axisName(axis)) + cell(`${percent(fraction)} %`) + cell(fractionBar(fraction), "") + end(0) + end(-1));
        });
        const rest = 1 - effects.reduce((sum, {fraction}) => sum + fraction, 0);
        if (effects.length > 1 && rest >= 0.0005) rows.push(textCell("") + textCell("interactions") + cell(`${percent(rest)} %`) + cell(fractionBar(rest), "") + cell("") + cell(""));
    });
    if (rows.length) showTable(section(host, "influences", "Effect of each axis", "percent of the variance over the grid that is explained by the means at the axis values; means at the first and last value"),
                               ["", "axis", "variance", "", "from", "to"], rows);
}

// A horizontal bar for a fraction from 0 to 1.
const fractionBar = (fraction) => `<span class="bar"><span class="full" style="width: ${100 * Math.min(1, Math.max(0, fraction))}%"></span></span>`;

function showGridPoints(host) {
    if (table.points.length < 2 || table.points.length > 400) return;
    const rows = table.points.map(({point, measures: found}) => textCell(point) + found.map(({mean}, k) => cell(mean.value === null ? "–" : measureText(k, mean.value))).join(""));
    showTable(section(host, "points", "By grid point", table.points.some(({items}) => items > 1) ? "means" : ""), ["", ...measures.map(({name}) => escaped(name))], rows);
}

/// At most `max` evenly spaced indices below `count`, including the first and the last.
const evenlySpaced = (count, max) => (count <= max ? [...Array(count).keys()] : [...Array(max).keys()].map((k) => Math.round(k * (count - 1) / (max - 1))));

/// Plots means of a measure over the values `xs` of axis `xAxis`. `lines`: [{label, ys}], one for each value of another axis, or a single one.
function showLines(host, measure, xAxis, xs, lines) {
    const axis = table.axes[xAxis], order = xs.map((x, k) => k).filter((k) => xs[k] !== null);
    const rows = order.map((k) => [xs[k], ...lines.map(({ys}) => ys[k])]);
    const labels = lines.map(({label}) => label);
    const shown = lines.length > 1 ? lines.map(({label}, k) => `<span class="line"><span class="chip" style="background: ${colour(k)}"></span>${escaped(label)}</span>`).join(" ") : "";
    const box = figure(host, `${escaped(measures[measure].name)} over ${escaped(axis.name)} <span class="unit">${shown}</span>`);
    const chart = plot(box, rows, [axis.name, ...labels], {x: escaped(axis.name), y: escaped(measures[measure].name), xUnit: axis.unit, yUnit: measures[measure].unit,
        series: Object.fromEntries(labels.map((label, k) => [label, {color: colour(k), strokeWidth: 1.6, drawPoints: true, pointSize: 2.5}])),
        drawBackground: (context, area, chart) => limitLines(context, area, chart, measure, false)});
    if (axis.words) chart.updateOptions({axes: {x: {ticker: () => xs.map((v) => ({v, label: escaped(levelText(xAxis, v))}))}}});
}

/// All plots of a measure: two line plots and a heat map for each pair of axes, or a line plot for each axis if there is no pair.
function showGrid(host, measure) {
    const {effects, pairs} = data.grids[measure] || {effects: [], pairs: []};
    if (!effects.length) return void element(host, "p", "note", `${escaped(measures[measure]?.name ?? "Nothing")} is constant over the grid.`);
    if (effects.length === 1 || !pairs.length)
        for (const {axis, values, means} of effects) showLines(host, measure, axis, values, [{label: measures[measure].name, ys: means}]);
    for (const {x, y, xs, ys, means} of pairs) {
        const across = evenlySpaced(ys.length, MAX_LINES), along = evenlySpaced(xs.length, MAX_LINES);
        showLines(host, measure, x, xs, across.map((j) => ({label: `${axisName(y)} ${levelText(y, ys[j])}`, ys: means.map((row) => row[j])})));
        showLines(host, measure, y, ys, along.map((i) => ({label: `${axisName(x)} ${levelText(x, xs[i])}`, ys: means[i]})));
        showHeatMap(host, measure, {x, y, xs, ys, means});
    }
}

/// A colour map like viridis for a fraction from 0 to 1: larger values are brighter, in the light and in the dark theme.
function heatColour(fraction) {
    const stops = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
    const at = Math.min(Math.max(fraction, 0), 1) * (stops.length - 1), k = Math.min(Math.floor(at), stops.length - 2);
    return `rgb(${stops[k].map((c, n) => Math.round(c + (at - k) * (stops[k + 1][n] - c))).join(" ")})`;
}

function showHeatMap(host, measure, map) {
    const {x, y, xs, ys, means} = map, known = means.flat().filter((v) => v !== null), low = Math.min(...known), high = Math.max(...known);
    const node = element(host, "figure", "heat");
    const scale = `<span class="heat-scale" style="background: linear-gradient(90deg, ${[0, 0.25, 0.5, 0.75, 1].map(heatColour).join(", ")})"></span>`;
    const others = table.axes.length > 2 ? ", mean over the other axes" : "";
    const caption = element(node, "figcaption", "", `<span class="title">${escaped(measures[measure].name)} <span class="unit">${measureText(measure, low)} ${scale} ${measureText(measure, high)}${others}</span></span>`);
    const readout = element(caption, "span", "readout"), canvas = element(node, "canvas");
    canvas.setAttribute("aria-label", `${measures[measure].name} over ${axisName(x)} and ${axisName(y)}`);
    const plotHeight = 260 - HEAT.top - HEAT.bottom;
    const cellAt = (event) => [Math.floor((event.offsetX - HEAT.left) / (canvas.clientWidth - HEAT.left - HEAT.right) * xs.length), ys.length - 1 - Math.floor((event.offsetY - HEAT.top) / plotHeight * ys.length)];
    const paint = () => paintHeatMap(canvas, map, plotHeight, (v) => (high > low ? (v - low) / (high - low) : 0.5));
    new ResizeObserver(paint).observe(node);
    canvas.addEventListener("mousemove", (event) => {
        const [i, j] = cellAt(event);
        readout.textContent = means[i]?.[j] === undefined ? "" : `${axisName(x)} ${levelText(x, xs[i])}, ${axisName(y)} ${levelText(y, ys[j])}: ${measureText(measure, means[i][j])}`;
    });
    canvas.addEventListener("mouseleave", () => { readout.textContent = ""; });
}

function paintHeatMap(canvas, {x, y, xs, ys, means}, plotHeight, fractionOf) {
    const fullWidth = canvas.parentElement.clientWidth, scale = devicePixelRatio || 1, context = canvas.getContext("2d");
    [canvas.width, canvas.height] = [fullWidth * scale, 260 * scale];
    canvas.style.height = "260px";
    context.scale(scale, scale);
    const width = fullWidth - HEAT.left - HEAT.right, w = width / xs.length, h = plotHeight / ys.length;
    means.forEach((row, i) => row.forEach((value, j) => {
        if (value === null) return;
        context.fillStyle = heatColour(fractionOf(value));
        context.fillRect(HEAT.left + i * w, HEAT.top + (ys.length - 1 - j) * h, Math.ceil(w), Math.ceil(h));
    }));
    context.font = "11px system-ui, sans-serif", context.fillStyle = themeColour("faint"), context.textAlign = "center";
    for (const i of evenlySpaced(xs.length, Math.max(2, Math.min(xs.length, Math.floor(width / 70))))) context.fillText(levelText(x, xs[i]), HEAT.left + (i + 0.5) * w, HEAT.top + plotHeight + 14);
    context.fillText(axisName(x), HEAT.left + width / 2, HEAT.top + plotHeight + 31);
    context.textAlign = "right", context.textBaseline = "middle";
    for (const j of evenlySpaced(ys.length, Math.max(2, Math.min(ys.length, Math.floor(plotHeight / 18))))) context.fillText(levelText(y, ys[j]), HEAT.left - 6, HEAT.top + (ys.length - 0.5 - j) * h);
    context.save();
    context.translate(9, HEAT.top + plotHeight / 2), context.rotate(-Math.PI / 2), context.textAlign = "center";
    context.fillText(axisName(y), 0, 0);
    context.restore();
}
