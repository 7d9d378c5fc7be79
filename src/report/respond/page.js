"use strict";
// Builds the report: heading, figures of the selected input and channel, tables.

const report = new Report(JSON.parse(document.getElementById("data").textContent));
const at = (id) => document.getElementById(id);
const view = new View({span: at("span"), now: at("now")});
const afferentTypes = afferentTypesOf(report.data.afferents);
const shown = {input: null, channel: null, traces: []};

function showHeading({title, program, command, notes}) {
    at("title").textContent = title;
    at("program").textContent = program;
    at("command").textContent = command;
    at("notes").hidden = !notes || !notes.length;
    at("notes").innerHTML = (notes || []).map((text) => `<li>${escaped(text)}</li>`).join("");
}

/// Shows the figures and tables of one channel of an input. The visible time range is kept if only the channel changes.
function show(input, channel) {
    const keep = shown.input === input;
    Object.assign(shown, {input, channel, traces: report.traces(input, channel)});
    const scroll = scrollY;
    view.clear();
    at("figures").replaceChildren();
    labelWidth(input);
    view.show([...forcePanels(), ...spikePanels(), ...afferentTypes.flatMap(afferentTypePanels)], input, keep);
    scrollTo(0, scroll);
    showChoice(input, channel);
    showRates(report.data.table, report.data.inputs, channel);
    showImplementations(report.data.comparisons, channel);
}

/// Sets the left margin of all panels (pixels), wide enough for the labels of the raster.
function labelWidth(input) {
    const labels = lanes(input, null).map(({label}) => label);
    const longest = labels.length <= MAX_LABELS ? Math.max(0, ...labels.map((label) => label.length)) : 0;
    view.labelWidth = isNarrow() ? Math.max(36, Math.min(90, 6 * longest + 10)) : Math.max(60, Math.min(130, 7 * longest));
    at("figures").style.setProperty("--left", view.labelWidth + 6 + "px");
}

/// Fills the selectors of input and channel; hides those with a single entry.
function showChoice(input, channel) {
    const {inputs} = report.data;
    at("choose-input").hidden = inputs.length < 2;
    at("choose-channel").hidden = input.channels.length < 2;
    at("input").innerHTML = inputs.map((one, k) => `<option value="${k}" ${one === input ? "selected" : ""}>${escaped(one.name)}</option>`).join("");
    at("channel").innerHTML = input.channels.map((one) => `<option value="${one.id}" ${one === channel ? "selected" : ""}>${escaped(one.name)}</option>`).join("");
}

/// Adds a section of figures with a heading. `chip`: colour of the mark before the title; "" for none.
function section(title, about = "", chip = "") {
    const host = element(at("figures"), "section");
    const mark = chip && `<span class="chip" style="background: ${chip}"></span>`;
    element(host, "h2", "", `${mark}${escaped(title)} <small>${escaped(about)}</small>`);
    return host;
}

function forcePanels() {
    const traces = shown.traces.filter((trace) => trace.afferent === null);
    if (!shown.traces.length) element(at("figures"), "p", "note", "No traces were recorded for this channel; its spikes are below.");
    if (!traces.length) return [];
    const host = section("Stimulus", [shown.channel.name, shown.input.description].filter(Boolean).join(": "));
    return byKind(traces).map(([, group], k, all) => new TracePanel({
        host, input: shown.input, traces: group, name: group[0].quantity, title: group.map((trace) => trace.quantity).join(", "),
        about: group.map((trace) => trace.quantity).join(", "), height: 120, bottom: k === all.length - 1, named: k === 0,
        series: group.map(({quantity}, n) => ({label: quantity, html: group.length > 1 ? symbolHtml(quantity) : "", width: 1.6,
                                           color: mixed(colour("ink"), colour("faint"), n / group.length)})),
    }));
}

function spikePanels() {
    const {input, channel} = shown, {afferents} = report.data;
    if (!afferents.length) return [];
    const {copies} = report.data, several = input.channels.length > 1 && !copies;
    const host = section("Spikes", copies ? aboutCopies(copies) : several ? `All channels; click a row to select its channel. Counts and frequencies are of channel ${channel.name}.` : "");
    const colours = afferents.map(({name}, index) => ({name, color: afferentColour(index), index}));
    const overlaid = afferentTypes.some(({members}) => members.length > 1);
    const trainsOf = (members) => members.map(({afferent, index}) => ({...colours[index], spikes: report.spikes(report.members(afferent)[0], channel)}));
    const frequency = (trains, prefix) => new FrequencyPanel({host, input, name: `${prefix}frequency`, about: `${prefix}instantaneous frequency`, height: prefix ? 110 : 150, trains,
                                                              title: `${prefix}instantaneous frequency`});
    return [
        new RasterPanel({host, input, name: "raster", about: "spikes", lanes: lanes(input, channel), afferents: colours, named: !shown.traces.length,
                         pick: several ? (one) => show(input, one) : null, grouped: several || copies || overlaid}),
        ...(copies ? [new PopulationPanel({host, input, name: "population", about: "mean rate of all copies", height: 150,
                                           rates: colours.map((one, k) => ({...one, ...report.rate(afferents[k], channel)}))})] : []),
        ...(overlaid && afferentTypes.length > 1 ? afferentTypes.map(({name, members}) => frequency(trainsOf(members), (members.length > 1 ? name : members[0].afferent.name) + " "))
                                             : [frequency(trainsOf(afferentTypes.flatMap(({members}) => members)), "")]),
    ];
}

/// The text that explains which copies the figures show.
function aboutCopies({count, shown, has_probes}) {
    const rows = shown === count ? `All ${count} copies of each afferent` : `The first ${shown} of ${count} copies of each afferent`;
    const traces = has_probes ? "Currents, membranes and instantaneous frequency are of copy 1." : `Instantaneous frequency is of copy 1; with more than ${shown} copies currents and membranes are not recorded.`;
    return `${rows}, one row per copy. The rate below is the mean over all ${count}. ${traces}`;
}

/// The lanes of the raster: every afferent on every channel, or the shown copies of every afferent on the selected channel. Labels omit the name of
/// the input; of a long label the end is shown. `chosen`: the selected channel, or null if only the labels are needed.
function lanes(input, chosen) {
    const shortened = (text) => (text.length > 18 ? "…" + text.slice(-17) : text);
    const channelName = ({name}) => (name.startsWith(input.name + ":") ? name.slice(input.name.length + 1) : name);
    const several = input.channels.length > 1 && !report.data.copies;
    const channels = report.data.copies ? [chosen || input.channels[0]] : input.channels;
    const lane = (member, channel, {afferent, index}, group) => ({
        afferent: afferent.name, group, channel, chosen: channel === chosen, color: afferentColour(index), spikes: report.spikes(member, channel),
        label: shortened(several ? `${member.name} ${channelName(channel)}` : member.name)});
    return afferentTypes.flatMap(({name, members}) => {
        const lanesOf = (one, on, group) => on.flatMap((channel) => report.members(one.afferent).map((member) => lane(member, channel, one, group)));
        // With several implementations on several channels, the implementations on one channel are adjacent if there is space for labels.
        const byChannel = members.length > 1 && several && report.data.afferents.length * channels.length <= MAX_LABELS;
        return byChannel ? channels.flatMap((channel) => members.flatMap((one) => lanesOf(one, [channel], name + channel.id)))
                      : members.flatMap((one) => lanesOf(one, channels, several || report.data.copies ? one.afferent.name : name));
    });
}

/// The channel of an input with the most spikes. It is shown first, because the first channel of many may have no force.
function mostActiveChannel(input) {
    const count = (channel) => report.data.afferents.flatMap((afferent) => report.members(afferent)).reduce((sum, one) => sum + report.spikes(one, channel).count, 0);
    return input.channels.reduce((best, channel) => (count(channel) > count(best) ? channel : best));
}

function connect() {
    const {inputs} = report.data;
    at("input").onchange = () => show(inputs[at("input").value], mostActiveChannel(inputs[at("input").value]));
    at("channel").onchange = () => show(shown.input, shown.input.channels.find((one) => String(one.id) === at("channel").value));
    at("earlier").onclick = () => view.pan(-0.25);
    at("later").onclick = () => view.pan(0.25);
    at("in").onclick = () => view.zoom(0.5);
    at("out").onclick = () => view.zoom(2);
    at("reset").onclick = () => view.reset();
    at("autoscale").onchange = () => { view.autoscale = at("autoscale").checked; view.request(); };
    connectKeys(view);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", recolour);
    addEventListener("beforeprint", () => setPrinting(true));
    addEventListener("afterprint", () => setPrinting(false));
}

/// Redraws everything after a change of theme, because figures read the colours of the style sheet when they are created.
function recolour() {
    showParameters(report.data.afferents);
    showCosts(report.data.costs, report.data.afferents);
    show(shown.input, shown.channel);
}

function setPrinting(on) {
    document.documentElement.classList.toggle("printing", on);
    recolour();
}

/// For tests and the browser's console.
///
///   charts                       The dygraphs by the name of their panel: "force", "sa1 current", "sa1 membrane", "raster", "frequency".
///                                With copies there is also "population". With several implementations the names are "sa1 I", "sa1 I_A",
///                                "sa1 u", "sa1 frequency"; values are those on the left axis.
///
///   valueAt(quantity, t, afferent)   The value on the selected channel at the sample nearest to t. It is [min, max] if the trace has only the
///                                minimum and maximum of several samples, and null if there is no such trace. "force" has no afferent.
///
///   window(), setWindow(a, b)    the time range in seconds; setting it redraws at once
///   pointsDrawn()                by panel: the number of rows last passed to its dygraph, and the width of its plot in pixels
window.corpuscle = {
    get charts() { return Object.fromEntries(view.panels.map((panel) => [panel.name, panel.chart])); },
    valueAt(quantity, t, afferent = null) {
        const trace = shown.traces.find((one) => one.quantity === quantity && one.afferent === afferent);
        if (!trace) return null;
        return trace.bucket === 1 ? trace.at(t)[0] : trace.at(t);
    },
    window: () => [view.a, view.b],
    setWindow(a, b) { view.set(a, b); view.draw(); },
    pointsDrawn: () => Object.fromEntries(view.panels.map(({name, chart, area}) => [name, {rows: chart.numRows(), width: area.w}])),
};

showHeading(report.data);
showParameters(report.data.afferents);
showCosts(report.data.costs, report.data.afferents);
showQuality(report.data.quality);
showTrials(report.data.trials);
showVersions(report.data.versions);
connect();
show(report.data.inputs[0], mostActiveChannel(report.data.inputs[0]));
