"use strict";
// The page of a sweep: yields, measures, influences, plots of the selected measure, and failed and extreme items.

const data = JSON.parse(document.getElementById("data").textContent);
const table = data.summary, measures = table.measures;
// data.rows has the values of those rows of the sweep that the page uses. rowNumber: row of the sweep -> index in the arrays of data.rows.
const rowNumber = new Map(data.rows.row.map((row, k) => [row, k]));
const state = {measure: 0, grouping: 0};  // indices of the selected measure and grouping

const grouping = () => data.groupings[state.grouping];
const groupName = (k) => grouping().groups[k];
const groupColour = (k) => (grouping().groups.length === 1 ? colour(0) : colour(k));

// Values of a measure or an axis, and groups in the selected grouping, for some rows of the sweep. Without measures, the row itself is the value.
const measured = (measure, rows) => !measures.length ? rows : rows.map((row) => data.rows.measures[measure][rowNumber.get(row)]);
const varied = (axis, rows) => rows.map((row) => data.rows.axes[axis][rowNumber.get(row)]);
const groupsOf = (rows) => rows.map((row) => data.rows.groups[state.grouping][rowNumber.get(row)]);

function section(host, id, title, note = "") {
    const node = element(host, "section");
    node.id = id;
    element(node, "h2", "", `${escaped(title)} <small>${escaped(note)}</small>`);
    return node;
}

/// Redraws everything that depends on the selected measure or grouping.
function draw() {
    charts.splice(0).forEach((chart) => chart.destroy());
    for (const id of ["figures", "rasters", "traces", "extremes"]) document.getElementById(id)?.replaceChildren();
    const plots = element(document.getElementById("figures"), "div", "plots");
    showKey();
    if (data.grids) showGrid(plots, state.measure);
    else if (measures.length) showHistogram(plots, state.measure), showNormalPlot(plots, state.measure);
    for (const factor of data.factors[state.measure] || []) showScatter(plots, state.measure, factor);
    for (const train of data.rasters) showRaster(document.getElementById("rasters"), train);
    for (const trace of data.traces) showEnvelope(document.getElementById("traces"), trace);
    showExtremes(document.getElementById("extremes"), state.measure);
}

/// Adds a selector. `onSelect` is called with the index of the selected option.
function chooser(host, id, name, options, onSelect) {
    const label = element(host, "label", "", `${escaped(name)} `);
    const select = element(label, "select", "", options.map((text, k) => `<option value="${k}">${escaped(text)}</option>`).join(""));
    select.id = id;
    select.addEventListener("change", () => { onSelect(Number(select.value)); draw(); });
}

/// The tables of a sweep with random parameters.
function startMonteCarlo(host) {
    showYields(section(host, "yields", "Yield", openingText()));
    if (!table.finished) return;
    showMeasures(section(host, "measures", "Measures", "with 95 % confidence intervals"));
    showPoints(host);
    showDependences(host);
}

function start(host) {
    document.getElementById("title").textContent = data.title;
    document.getElementById("program").textContent = data.program;
    document.getElementById("command").textContent = data.command;
    if (data.grids) startGrid(host);
    else startMonteCarlo(host);
    if (!table.finished) return;
    const bar = element(host, "div");
    bar.id = "toolbar";
    if (measures.length) chooser(bar, "measure", "Measure", measures.map(({name}) => name), (k) => (state.measure = k));
    if (data.groupings.length > 1 && (!data.grids || data.rasters.length || data.traces.length)) chooser(bar, "grouping", "Colour by", data.groupings.map(({name}) => name), (k) => (state.grouping = k));
    const key = element(bar, "span", "key");
    key.id = "key";
    element(host, "div").id = "figures";
    if (data.rasters.length) element(host, "section").id = "rasters";
    if (data.traces.length) element(host, "section").id = "traces";
    element(host, "section").id = "extremes";
    showFailed(host);
    draw();
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
}

start(document.getElementById("sweep"));
