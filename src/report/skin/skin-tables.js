"use strict";
// The tables of a skin page: first spikes, rates by class and phase, classes, sources, densities.

const chipOf = (color) => `<span class="chip" style="background: ${color}"></span>`;

/// A table as HTML. `head` and `rows` are HTML; `numeric(c)` returns true if column c has numbers.
function tableHtml(head, rows, numeric = () => false) {
    const cell = (tag, c, html) => `<${tag}${numeric(c) ? ' class="number"' : ""}${tag === "th" ? ' scope="col"' : ""}>${html}</${tag}>`;
    return `<table><thead><tr>${head.map((html, c) => cell("th", c, html)).join("")}</tr></thead>
        <tbody>${rows.map((row) => `<tr>${row.map((html, c) => cell("td", c, html)).join("")}</tr>`).join("")}</tbody></table>`;
}

/// The afferents that fired first, each with its first spike and its delay after the first force on the skin.
function showFirstSpikes(skin, host) {
    const {first_spikes, input} = skin.data.summary, touched = input.touched_from_s;
    if (!first_spikes.length) return void (host.innerHTML = "<p class=\"note\">No afferent fired.</p>");
    const rows = first_spikes.map(({afferent_index, afferent, region, time_s}, k) => [String(k + 1), chipOf(skin.classOf(skin.markOf(afferent_index)).color) + escaped(afferent), escaped(region), time_s.toFixed(6),
        touched === null ? "–" : ((time_s - skin.t0 - touched) * 1e3).toFixed(3).replace("-", "−")]);
    host.innerHTML = tableHtml(["", "afferent", "region", "first spike (s)", "after first force (ms)"], rows, (c) => c === 0 || c >= 3);
}

// The columns of the table of rates: key in the summary, heading, decimals.
const RATE_COLUMNS = [["phase", "phase"], ["afferents", "afferents", 0], ["touched", "touched", 0], ["active", "active", 0], ["spikes", "spikes", 0], ["rate_while_touched_Hz", "rate while touched (Hz)", 1],
                      ["rate_of_active_Hz", "mean rate of active (Hz)", 1], ["max_rate_Hz", "busiest (Hz, over the phase)", 1], ["first_spike_s", "first spike (s)", 4], ["median_first_spike_s", "median first spike (s)", 4]];

/// The rates of all classes and phases in a region; "all" for the complete skin.
function showSkinRates(skin, host, region) {
    const phases = skin.data.summary.input.phases.length > 0, columns = RATE_COLUMNS.filter(([key]) => phases || key !== "phase");
    const rows = skin.data.summary.rates.filter((row) => row.region === region).map((row) => [row.afferent, ...columns.map(([key]) => row[key])]);
    fillRates(host, {columns: ["afferent", ...columns.map(([, name]) => name)], decimals: [undefined, ...columns.map(([, , decimals]) => decimals)], rows}, null);
}

const millimetres = (metres) => (metres ? `${Number((metres * 1e3).toPrecision(3))} mm` : "–");

function showClasses(skin, host) {
    const rows = skin.data.summary.classes.map((one, k) => {
        const {sigma_m, depth_m, surround, hot_spots, hot_spot_spread_m} = one.receptive_field, {velocity_m_s, standard_deviation_m_s} = one.conduction, about = skin.classes[k];
        const shape = depth_m ? `stress at ${millimetres(depth_m)}${surround ? `, surround ${surround}` : ""}` : sigma_m ? `Gaussian, σ ${millimetres(sigma_m)}` : "nearest site";
        const field = `${shape}${hot_spots > 1 ? `; ${hot_spots} hot spots, spread ${millimetres(hot_spot_spread_m)}` : ""}`;
        const speed = velocity_m_s ? `${quantity(velocity_m_s, "m/s", true)}${standard_deviation_m_s ? ` ± ${quantity(standard_deviation_m_s, "m/s", true)}` : ""}` : "no delay";
        return [chipOf(about.color) + escaped(one.name), String(one.afferents), escaped(about.composition), escaped(field), escaped(speed), escaped([about.description, one.source || about.source].filter(Boolean).join("; "))];
    });
    host.innerHTML = tableHtml(["class", "afferents", "model", "receptive field", "conduction velocity", "description and source"], rows, (c) => c === 1);
}

/// The literature from which the population's numbers are; a source of several numbers is listed once.
function showSources(skin, host) {
    const {classes, skin: about} = skin.data.summary, entries = new Map();
    const add = ({quantity, source}, name) => entries.set(source, [...(entries.get(source) || []), name ? `${quantity} of ${name}` : quantity]);
    about.sources.forEach((one) => add(one, ""));
    classes.forEach(({name, sources}) => sources.forEach((one) => add(one, name)));
    host.innerHTML = Array.from(entries, ([source, quantities]) => `<li>${escaped(quantities.join(", "))}: ${escaped(source)}</li>`).join("");
    host.hidden = !entries.size;
}

/// The number of afferents of each class in each region, and their density per cm².
function showDensities(skin, host) {
    const {classes, skin: about} = skin.data.summary, names = skin.regions;
    if (names.length < 2 && !classes.some((one) => Object.values(one.regions).some(({afferents_per_cm2}) => afferents_per_cm2 !== undefined))) return void (host.hidden = true);
    const rows = names.map((name) => {
        const area = about.regions[name].area_cm2;
        return [escaped(name), area ? area.toFixed(2) : "–", ...classes.map((one) => {
            const {afferents, afferents_per_cm2} = one.regions[name];
            return `${afferents}${afferents_per_cm2 === undefined ? "" : ` <span class="unit">(${Number(afferents_per_cm2.toPrecision(3))} /cm²)</span>`}`;
        })];
    });
    host.innerHTML = tableHtml(["region", "area (cm²)", ...skin.classes.map((one) => chipOf(one.color) + escaped(one.name))], rows, (c) => c >= 1);
}
