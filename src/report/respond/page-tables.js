"use strict";
// The tables of the report: rates, recording quality, costs, parameters, versions.

const MAX_ROWS = 2000;  // rows of a table; more would slow the browser. All rows are in summary.json

/// The table of measures for the selected channel or, if the checkbox is set, for all channels.
function showRates(table, inputs, channel) {
    const section = document.getElementById("rates");
    section.hidden = !table || !table.rows.length;
    if (section.hidden) return;
    const all = document.getElementById("all-rows");
    const several = inputs.reduce((sum, one) => sum + one.channels.length, 0) > 1;
    document.getElementById("choose-rows").hidden = !several;
    const fill = () => fillRates(section.querySelector(".scroll"), table, several && !all.checked ? channel.name : null);
    all.onchange = fill;
    fill();
}

/// Fills `host` with a table of rows. `only`: the channel whose rows are shown; null for all rows. `startsGroup(row, before)`: true if a line
/// separates a row from the row before.
function fillRates(host, {columns, decimals, rows}, only, startsGroup = (row, before) => row[0] !== before[0]) {
    const wanted = rows.filter((row) => !only || row[columns.indexOf("channel")] === only);
    const numeric = columns.map((_, c) => rows.some((row) => typeof row[c] === "number" || Array.isArray(row[c])));
    const cell = (tag, c, text) => `<${tag}${numeric[c] ? ' class="number"' : ""}${tag === "th" ? ' scope="col"' : ""}>${escaped(text)}</${tag}>`;
    const line = (row, k) => `<tr${k && startsGroup(row, wanted[k - 1]) ? ' class="group"' : ""}>${row.map((value, c) => cell("td", c, cellText(value, decimals[c]))).join("")}</tr>`;
    host.innerHTML = `<table><thead><tr>${columns.map((name, c) => cell("th", c, name)).join("")}</tr></thead>
        <tbody>${wanted.slice(0, MAX_ROWS).map(line).join("")}</tbody></table>`;
    if (wanted.length > MAX_ROWS) element(host, "p", "note", `The first ${MAX_ROWS} of ${wanted.length} rows.`);
}

/// Comparison of the implementations of each afferent type on the selected channel.
function showImplementations(table, channel) {
    const section = document.getElementById("comparisons");
    section.hidden = !table || !table.rows.length;
    if (section.hidden) return;
    section.querySelector(".note").textContent = `Each implementation is compared with the first of its afferent type. Spikes within ${quantity(2 / table.cost, "s", true)} match; ` +
        `a positive shift means later than the reference. Victor-Purpura cost ${quantity(table.cost, "Hz", true)}, van Rossum time constant ${quantity(table.tau, "s", true)}.`;
    const isFirst = (row) => row[table.columns.indexOf("matched")] === null;
    fillRates(section.querySelector(".scroll"), table, channel.name, isFirst);
}

/// Quality findings of the recordings, for each recording the warnings first, and the quality metrics of each channel.
function showQuality({notes, columns, rows}) {
    const section = document.getElementById("quality");
    section.hidden = !rows.length;
    if (section.hidden) return;
    section.querySelector("ul").innerHTML = notes.map(({text, grave}) => `<li${grave ? ' class="grave"' : ""}>${escaped(text)}</li>`).join("") ||
        "<li>No problems were found.</li>";
    fillRates(section.querySelector(".scroll"), {columns, decimals: [], rows}, null);
}

/// Power and area of afferents that are netlists, by block.
function showCosts(costs, afferents) {
    const section = document.getElementById("costs");
    section.hidden = !costs || !costs.length;
    if (section.hidden) return;
    section.querySelector(".columns").innerHTML = costs.map((cost) => costTable(cost, afferents.findIndex((one) => one.name === cost.afferent))).join("");
}

/// An area in m², as text in µm².
const squareMicrons = (area) => (area ? (area * 1e12).toFixed(0) : "–");

/// The table of one netlist. `index`: of its afferent, for the colour.
function costTable({afferent, rest_force_N, power, area, blocks, afferents}, index) {
    const text = (value, unit) => escaped(quantity(value, unit, true));
    const row = (head, cells) => `<tr><th scope="row">${head}</th>${cells.map((cell) => `<td class="number">${cell}</td>`).join("")}</tr>`;
    const head = ["block", `power at rest (${text(rest_force_N, "N")})`, "area (µm²)", "leakage when off"].map((cell) => `<th scope="col">${cell}</th>`).join("");
    // Blocks with transistors, and other blocks that take more than a millionth of the delivered power.
    const listed = blocks.filter((one) => one.area.total_m2 || Math.abs(power.op.blocks_W[one.block]) > 1e-6 * power.op.delivered_W);
    const rows = listed.map((one) => row(escaped(one.block), [text(power.op.blocks_W[one.block], "W"), squareMicrons(one.area.total_m2),
        one.worst_leak ? text(one.worst_leak.current_A, "A") : "–"]));
    const mean = power.mean ? `; mean ${text(power.mean.delivered_W, "W")}, of which sensor ${text(power.mean.sensor_W, "W")}` : "";
    const density = afferents ? ` Density: ${text(afferents.per_mm2, "")} per mm².` : "";
    return `<table class="costs"><caption><span class="chip" style="background: ${afferentColour(index)}"></span>${escaped(afferent)}
        <span class="unit">power at rest ${text(power.op.delivered_W, "W")}, of which sensor ${text(power.op.sensor_W, "W")}${mean}.${density}</span></caption>
        <thead><tr>${head}</tr></thead><tbody>${rows.join("")}${row("total", [text(power.op.delivered_W, "W"), squareMicrons(area.total_m2), ""])}</tbody></table>`;
}

function showParameters(afferents) {
    const section = document.getElementById("parameters");
    const listed = afferents.map((one, index) => ({...one, index})).filter((one) => one.parameters && one.parameters.length);
    section.hidden = !listed.length;
    section.querySelector(".columns").innerHTML = listed.map(parameterTable).join("");
}

function parameterTable({name, composition, parameters, index}) {
    const head = ["model", "parameter", "value", "default", "description"].map((text) => `<th scope="col">${text}</th>`).join("");
    return `<table class="parameters"><caption><span class="chip" style="background: ${afferentColour(index)}"></span>${escaped(name)}
        <span class="unit">${escaped(composition || "")}</span></caption><thead><tr>${head}</tr></thead><tbody>${parameters.map(parameterRow).join("")}</tbody></table>`;
}

function parameterRow(parameter, k, all) {
    const first = !k || all[k - 1].component !== parameter.component;
    const source = parameter.source ? ` <span class="unit">(${escaped(parameter.source)})</span>` : "";
    const text = (value) => escaped(quantity(value, parameter.unit || "", true));
    return `<tr class="${parameter.set ? "set" : ""} ${first && k ? "group" : ""}"><td>${first ? escaped(parameter.component || "") : ""}</td>
        <th scope="row">${escaped(parameter.name)}</th><td class="number">${text(parameter.value)}${parameter.spread === undefined ? "" : ` ± ${text(parameter.spread)}`}${parameter.spread_factor === undefined ? "" : ` ×/÷ ${escaped(String(parameter.spread_factor))}`}${parameter.set ? ' <span class="tag">set</span>' : ""}</td>
        <td class="number">${text(parameter.default)}</td><td>${escaped(parameter.description || "")}${source}</td></tr>`;
}

function showVersions(versions) {
    const entries = Object.entries(versions || {});
    const section = document.getElementById("versions");
    section.hidden = !entries.length;
    section.querySelector("dl").innerHTML = entries.map(([name, text]) => `<div><dt>${escaped(name)}</dt><dd>${escaped(text)}</dd></div>`).join("");
}
