"use strict";
// The tables of a sweep's page.

const colour = (k) => getComputedStyle(document.documentElement).getPropertyValue(`--series-${k % 8}`).trim();
const ink = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
const charts = [];

function element(host, tag, kind = "", html = "") {
    const made = document.createElement(tag);
    if (kind) made.className = kind;
    made.innerHTML = html;
    return host.appendChild(made);
}

const percent = (share) => (share === null ? "–" : `${(100 * share).toFixed(1)}`);
const range = ({low, high}, text) => (low === null && high === null ? "" : ` <span class="range">${text(low)} … ${text(high)}</span>`);
const cell = (html, kind = "number") => `<td class="${kind}">${html}</td>`;
const word = (text) => cell(escaped(text), "");
const headed = (name, unit) => escaped(name) + (unit && ` <span class="unit">(${escaped(unit)})</span>`);

function showTable(host, head, rows) {
    const kinds = [...(rows[0] || "").matchAll(/<t[dh]([^>]*)>/g)].map(([, said]) => (said.includes("number") ? "number" : ""));
    const cells = head.map((text, k) => `<th scope="col" class="${kinds[k] || ""}">${text}</th>`).join("");
    const made = element(host, "div", "scroll", `<table${head.length > 4 ? ' class="many"' : ""}><thead><tr>${cells}</tr></thead><tbody>${rows.map((row) => `<tr>${row}</tr>`).join("")}</tbody></table>`);
    const names = [...made.querySelectorAll("thead th")].map((one) => one.textContent);
    for (const row of made.querySelectorAll("tbody tr"))  // on a narrow screen each cell says what it is
        if (row.cells.length === names.length) [...row.cells].forEach((one, k) => { one.dataset.head = names[k]; });
    return made;
}

function openingText() {
    const {units, finished, all} = table, parts = [finished === units ? `${units} units, all finished` : `${finished} of ${units} units are finished`];
    if (all.capped) parts.push(`${all.capped} stopped, too costly`);
    if (all.lost) parts.push(`${all.lost} lost, not converged`);
    return parts.join("; ");
}

function limitsText({unit, at_least: low, at_most: high}) {
    const text = (value) => quantity(value, unit, true);
    return low !== null && high !== null ? `${text(low)} … ${text(high)}` : low !== null ? `at least ${text(low)}` : `at most ${text(high)}`;
}

/// A bar from 0 to 1 with the interval as a stroke on it.
function bar({value, low, high}) {
    return `<span class="bar"><span class="full" style="width: ${100 * value}%"></span><span class="whisker" style="left: ${100 * low}%; width: ${100 * (high - low)}%"></span></span>`;
}

function yieldRow(name, limits, share, units) {
    const {value} = share;
    return word(name) + word(limits) + cell(`${Math.round(value * units)} of ${units}`) + cell(`${percent(value)} %${range(share, (x) => percent(x))}`) + cell(bar(share), "");
}

function showYields(host) {
    const {all, axes} = table, limited = measures.some((m) => "at_least" in m);
    if (!table.finished) return;
    const rows = [yieldRow(limited ? "all limits" : "ended", "", all.yield, all.units)];
    all.measures.forEach((one, k) => one.yield && rows.push(yieldRow(one.name, limitsText(measures[k]), one.yield, all.units)));
    showTable(host, ["", "limits", "passed", "yield, 95 %", ""], rows);
    if (axes.length) element(host, "p", "note", `Varied: ${axes.map(({name, sentence}) => `<b>${escaped(name)}</b>${sentence ? ` (${escaped(sentence)})` : ""}`).join(", ")}.`);
}

function showMeasures(host) {
    const named = table.quantiles.map((q) => (q === 0.5 ? "median" : `${100 * q} %`));
    const rows = table.all.measures.map((one, k) => {
        const {unit} = measures[k], text = (value) => quantity(value, unit, true), told = (estimate) => cell(text(estimate.value) + range(estimate, text));
        const {correlation, of_normal_samples_at_least: floor} = one.normal_plot;
        const normal = correlation === null ? "–" : `${correlation.toFixed(4)}, ${correlation >= floor ? "normal" : "not normal"}`;
        return `<th scope="row">${escaped(one.name)}</th>` + cell(one.units) + told(one.mean) + told(one.sigma) + cell(text(one.least)) +
            one.quantiles.map((q) => `<td class="number" title="${text(q.low)} … ${text(q.high)}">${text(q.value)}</td>`).join("") + cell(text(one.greatest)) + cell(normal, "");
    });
    showTable(host, ["", "units", "mean", "sigma", "least", ...named, "most", "normal plot"], rows);
}

function showPoints(host) {
    if (table.points.length < 2) return;
    const rows = table.points.map((point) => word(point.point) + cell(point.units) + cell(`${percent(point.yield.value)} %${range(point.yield, percent)}`) +
        point.measures.map(({mean, sigma}, k) => cell(mean.value === null ? "–" : `${quantity(mean.value, measures[k].unit, true)} ± ${quantity(sigma.value, measures[k].unit, true)}`)).join(""));
    showTable(section(host, "points", "Point by point", "mean ± sigma"), ["", "units", "yield, 95 %", ...measures.map(({name}) => escaped(name))], rows);
}

function showDependences(host) {
    const rows = [];
    for (const {measure, between_points: points, influences, devices, explained} of table.depends_on) {
        const first = () => (rows.some((row) => row.includes(`data-measure="${escaped(measure)}"`)) ? word("") : `<th scope="row" data-measure="${escaped(measure)}">${escaped(measure)}</th>`);
        const add = (name, what, share, rest) => rows.push(first() + word(name) + cell(what, "unit") + cell(share) + rest);
        const blank = cell("") + cell("") + cell("");
        for (const {axis, share} of points) add(axis, "point of the grid, share of all", `${percent(share)} %`, blank);
        for (const {axis, share} of influences) if (axis && share.value >= 0.0005) add(axis, "drawn", `${percent(share.value)} %${range(share, percent)}`, blank);
        for (const one of devices.slice(0, 8))
            add(one.device, escaped(data.sizes[one.device] || ""), `${percent(one.share)} %`, cell(percent(one.share_V_T)) + cell(percent(one.share_I_S)) +
                cell(measure === "yield" ? "" : `${(100 * (one.sigma_with_four_times_the_area - 1)).toFixed(1).replace("-", "−")} %`));
        if (influences.length) rows.push(`${word("")}<td class="unit" colspan="6">straight lines explain ${percent(explained)} % of what is drawn</td>`);
    }
    if (!rows.length) return;
    const host_ = section(host, "matters", "What matters", "share of the variance: of a grid's points of all of it, else of that between the chips of a point; only what stands out of chance");
    showTable(host_, ["", "", "", "share, 95 %", "of V<sub>T</sub> (%)", "of I<sub>S</sub> (%)", "sigma with 4× the area"], rows);
}

/// Rows of units: their axes, then measures; what is beyond its limit is marked.
function showUnits(host, rows, why) {
    const head = ["unit", ...table.axes.map(({name, unit}) => headed(name, unit)), ...measures.map(({name}) => escaped(name)), ...(why ? ["why"] : [])];
    const lines = rows.map((row) => {
        const k = rowNumber.get(row), unit = data.rows.unit[k];
        const axes = table.axes.map(({words}, a) => { const value = data.rows.axes[a][k]; return cell(words ? escaped(words[value] ?? "–") : cellText(value)); });
        const values = measures.map((m, i) => {
            const value = data.rows.measures[i][k], off = "at_least" in m && !((m.at_least === null || value >= m.at_least) && (m.at_most === null || value <= m.at_most) && value !== null);
            return cell(quantity(value, m.unit, true), off ? "number fails" : "number");
        });
        const said = data.rows.end[k] ? data.why[unit] || ["", "too costly", "not converged"][data.rows.end[k]] : "limits";
        return cell(unit) + axes.join("") + values.join("") + (why ? word(said) : "");
    });
    showTable(host, head, lines);
}

function showFailed(host) {
    if (!data.failed.length) return;
    const failed = table.all.units - table.all.passed;
    const note = data.failed.length < failed ? `the first ${data.failed.length} of ${failed}` : `${failed}`;
    showUnits(section(host, "failed", "Units that did not pass", note), data.failed, true);
}

function showExtremes(host, measure) {
    if (!measures.length) return;
    element(host, "h2", "", `Units with the least and the most ${escaped(measures[measure].name)}`);
    showUnits(host, data.extremes[measure], false);
    if (data.alone) element(host, "p", "note", escaped(data.alone));
}
