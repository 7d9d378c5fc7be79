"use strict";
// The tables of a sweep page.

const colour = (k) => getComputedStyle(document.documentElement).getPropertyValue(`--series-${k % 8}`).trim();
const themeColour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
const charts = [];  // all plots of the page

function element(host, tag, kind = "", html = "") {
    const node = document.createElement(tag);
    if (kind) node.className = kind;
    node.innerHTML = html;
    return host.appendChild(node);
}

// HTML of parts of tables: a fraction in percent, a confidence interval, cells, a heading with its unit.
const percent = (fraction) => (fraction === null ? "–" : `${(100 * fraction).toFixed(1)}`);
const range = ({low, high}, text) => (low === null && high === null ? "" : ` <span class="range">${text(low)} … ${text(high)}</span>`);
const cell = (html, kind = "number") => `<td class="${kind}">${html}</td>`;
const textCell = (text) => cell(escaped(text), "");
const headed = (name, unit) => escaped(name) + (unit && ` <span class="unit">(${escaped(unit)})</span>`);

/// A table. `head`: HTML of the headings; `rows`: HTML cells of each row. Columns of numbers are aligned as in the first row.
function showTable(host, head, rows) {
    const kinds = [...(rows[0] || "").matchAll(/<t[dh]([^>]*)>/g)].map(([, attributes]) => (attributes.includes("number") ? "number" : ""));
    const cells = head.map((text, k) => `<th scope="col" class="${kinds[k] || ""}">${text}</th>`).join("");
    const node = element(host, "div", "scroll", `<table${head.length > 4 ? ' class="many"' : ""}><thead><tr>${cells}</tr></thead><tbody>${rows.map((row) => `<tr>${row}</tr>`).join("")}</tbody></table>`);
    const names = [...node.querySelectorAll("thead th")].map((one) => one.textContent);
    for (const row of node.querySelectorAll("tbody tr"))  // on a narrow screen CSS shows data-head beside each cell
        if (row.cells.length === names.length) [...row.cells].forEach((one, k) => { one.dataset.head = names[k]; });
    return node;
}

function openingText() {
    const {items, finished, all} = table, parts = [finished === items ? `${items} items, all finished` : `${finished} of ${items} items are finished`];
    if (all.truncated) parts.push(`${all.truncated} truncated (too many steps or iterations)`);
    if (all.diverged) parts.push(`${all.diverged} diverged`);
    return parts.join("; ");
}

function limitsText({unit, at_least: low, at_most: high}) {
    const text = (value) => quantity(value, unit, true);
    return low !== null && high !== null ? `${text(low)} … ${text(high)}` : low !== null ? `min ${text(low)}` : `max ${text(high)}`;
}

/// A bar for a fraction from 0 to 1, with its confidence interval as a line.
function bar({value, low, high}) {
    return `<span class="bar"><span class="full" style="width: ${100 * value}%"></span><span class="whisker" style="left: ${100 * low}%; width: ${100 * (high - low)}%"></span></span>`;
}

function yieldRow(name, limits, estimate, items) {
    const {value} = estimate;
    return textCell(name) + textCell(limits) + cell(`${Math.round(value * items)} of ${items}`) + cell(`${percent(value)} %${range(estimate, (x) => percent(x))}`) + cell(bar(estimate), "");
}

function showYields(host) {
    const {all, axes} = table, limited = measures.some((m) => "at_least" in m);
    if (!table.finished) return;
    const rows = [yieldRow(limited ? "all limits" : "completed", "", all.yield, all.items)];
    all.measures.forEach((one, k) => one.yield && rows.push(yieldRow(one.name, limitsText(measures[k]), one.yield, all.items)));
    showTable(host, ["", "limits", "passed", "yield, 95 % CI", ""], rows);
    if (axes.length) element(host, "p", "note", `Varied: ${axes.map(({name, description}) => `<b>${escaped(name)}</b>${description ? ` (${escaped(description)})` : ""}`).join(", ")}.`);
}

function showMeasures(host) {
    const quantileHeads = table.quantiles.map((q) => (q === 0.5 ? "median" : `${100 * q} %`));
    const rows = table.all.measures.map((one, k) => {
        const {unit} = measures[k], text = (value) => quantity(value, unit, true), withRange = (estimate) => cell(text(estimate.value) + range(estimate, text));
        const {correlation, min_of_normal_samples: floor} = one.normal_plot;
        const normal = correlation === null ? "–" : `${correlation.toFixed(4)}, ${correlation >= floor ? "normal" : "not normal"}`;
        return `<th scope="row">${escaped(one.name)}</th>` + cell(one.items) + withRange(one.mean) + withRange(one.sigma) + cell(text(one.min)) +
            one.quantiles.map((q) => `<td class="number" title="${text(q.low)} … ${text(q.high)}">${text(q.value)}</td>`).join("") + cell(text(one.max)) + cell(normal, "");
    });
    showTable(host, ["", "items", "mean", "sigma", "min", ...quantileHeads, "max", "normality (r)"], rows);
}

function showPoints(host) {
    if (table.points.length < 2) return;
    const rows = table.points.map((point) => textCell(point.point) + cell(point.items) + cell(`${percent(point.yield.value)} %${range(point.yield, percent)}`) +
        point.measures.map(({mean, sigma}, k) => cell(mean.value === null ? "–" : `${quantity(mean.value, measures[k].unit, true)} ± ${quantity(sigma.value, measures[k].unit, true)}`)).join(""));
    showTable(section(host, "points", "By grid point", "mean ± sigma"), ["", "items", "yield, 95 % CI", ...measures.map(({name}) => escaped(name))], rows);
}

/// The table of influences: for each measure, and for the yield, the axes and devices that explain its variance.
function showDependences(host) {
    const rows = [];
    for (const {measure, between_points: points, influences, devices, explained_fraction: explained} of table.depends_on) {
        const first = () => (rows.some((row) => row.includes(`data-measure="${escaped(measure)}"`)) ? textCell("") : `<th scope="row" data-measure="${escaped(measure)}">${escaped(measure)}</th>`);
        const add = (name, kind, fraction, rest) => rows.push(first() + textCell(name) + cell(kind, "unit") + cell(fraction) + rest);
        const blank = cell("") + cell("") + cell("");
        for (const {axis, fraction} of points) add(axis, "grid axis, of the total variance", `${percent(fraction)} %`, blank);
        for (const {axis, fraction} of influences) if (axis && fraction.value >= 0.0005) add(axis, "random", `${percent(fraction.value)} %${range(fraction, percent)}`, blank);
        for (const one of devices.slice(0, 8))
            add(one.device, escaped(data.sizes[one.device] || ""), `${percent(one.fraction)} %`, cell(percent(one.fraction_V_T)) + cell(percent(one.fraction_I_S)) +
                cell(measure === "yield" ? "" : `${(100 * (one.relative_sigma_at_4x_area - 1)).toFixed(1).replace("-", "−")} %`));
        if (influences.length) rows.push(`${textCell("")}<td class="unit" colspan="6">a linear model explains ${percent(explained)} % of the random variance</td>`);
    }
    if (!rows.length) return;
    const node = section(host, "influences", "Influences", "percent of variance: for grid axes of the total, for random parameters of the variance within a grid point; only significant effects are listed");
    showTable(node, ["", "", "", "variance, 95 % CI", "by V<sub>T</sub> (%)", "by I<sub>S</sub> (%)", "sigma at 4× area"], rows);
}

/// A table of items with their axis values and measures. `rows`: rows of the sweep. Measures beyond their limits are marked. `withReason`: add a
/// column with the reason why an item failed.
function showItems(host, rows, withReason) {
    const head = ["item", ...table.axes.map(({name, unit}) => headed(name, unit)), ...measures.map(({name}) => escaped(name)), ...(withReason ? ["reason"] : [])];
    const lines = rows.map((row) => {
        const k = rowNumber.get(row), item = data.rows.item[k];
        const axes = table.axes.map(({words}, a) => { const value = data.rows.axes[a][k]; return cell(words ? escaped(words[value] ?? "–") : cellText(value)); });
        const values = measures.map((m, i) => {
            const value = data.rows.measures[i][k], off = "at_least" in m && !((m.at_least === null || value >= m.at_least) && (m.at_most === null || value <= m.at_most) && value !== null);
            return cell(quantity(value, m.unit, true), off ? "number fails" : "number");
        });
        // end: 0 completed, 1 truncated, 2 diverged
        const reason = data.rows.end[k] ? data.reasons[item] || ["", "too many steps or iterations", "did not converge"][data.rows.end[k]] : "limits";
        return cell(item) + axes.join("") + values.join("") + (withReason ? textCell(reason) : "");
    });
    showTable(host, head, lines);
}

function showFailed(host) {
    if (!data.failed.length) return;
    const failed = table.all.items - table.all.passed;
    const note = data.failed.length < failed ? `the first ${data.failed.length} of ${failed}` : `${failed}`;
    showItems(section(host, "failed", "Failed items", note), data.failed, true);
}

function showExtremes(host, measure) {
    if (!measures.length) return;
    element(host, "h2", "", `Items with the smallest and largest ${escaped(measures[measure].name)}`);
    showItems(host, data.extremes[measure], false);
    if (data.single_chip_hint) element(host, "p", "note", escaped(data.single_chip_hint));
}
