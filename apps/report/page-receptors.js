"use strict";
// The figures of a receptor: of one version its currents, membranes and what else it shows; of several, each quantity over each other.

function receptorPanels({name, members}) {
    const traced = members.map((member) => ({...member, traces: shown.traces.filter((trace) => trace.afferent === member.afferent.name)}));
    if (!traced.some(({traces}) => traces.length)) return [];
    const about = ({afferent}) => [report.data.copies ? "copy 1" : "", afferent.made_of, afferent.sentence].filter(Boolean).join(": ");
    if (members.length === 1) {
        const host = section(members[0].afferent.name, about(members[0]), afferentColour(members[0].index));
        return withTimes(traced[0].traces.length ? afferentPanels(host, traced[0], traced[0].traces) : []);
    }
    const host = section(name);
    const list = element(host, "ul", "versions");
    for (const {afferent, index} of members)
        element(list, "li", "", `<span class="chip" style="background: ${afferentColour(index)}"></span><b>${escaped(afferent.name)}</b> ${escaped(about({afferent}))}`);
    return withTimes(versionPanels(host, name, traced));
}

/// The last panel of a section shows the times.
function withTimes(panels) {
    if (panels.length) panels[panels.length - 1].showTimes();
    return panels;
}

/// Each quantity that several versions have, over each other; then what only one of them has.
function versionPanels(host, name, members) {
    const quantities = new Map();
    for (const member of members)
        for (const trace of member.traces.filter((one) => !isFront(one, member.traces))) {
            const key = trace.unit + quantityOf(trace.part);
            quantities.set(key, [...(quantities.get(key) || []), {trace, member}]);
        }
    const shared = [...quantities.values()].filter((list) => new Set(list.map(({member}) => member)).size > 1);
    const currents = shared.filter(([{trace}]) => trace.unit === "A").sort(([one], [other]) => isWhole(other.trace) - isWhole(one.trace));
    const membranes = shared.filter(([{trace}]) => trace.unit === "V" && isWhole(trace));
    const windows = members.map((member) => membranes.flatMap((list) => list.filter((one) => one.member === member))
        .map(({trace}) => windowOf(member, trace, report.spikes(report.members(member.afferent)[0], shown.channel)))[0]);
    const scales = {A: currentScales(members, currents), V: membraneScales(members, windows)};
    for (const text of scaleSentences(members, scales.A, scales.V, windows)) element(host, "p", "note", escaped(text));
    const over = [...currents, ...membranes].map((list) => overlay(host, name, members, list, scales));
    const alone = (trace) => ![...currents, ...membranes].flat().some((one) => one.trace === trace);
    return [...over, ...members.flatMap((member) => afferentPanels(host, member, member.traces.filter(alone), true))];
}

function overlay(host, name, members, list, scales) {
    const [{trace, member}] = list, whole = isWhole(trace);
    const V_th = trace.unit === "V" && scales.V[members.indexOf(member)].own ? member.afferent.V_th : null;
    const title = `${{A: whole ? "current " : "", V: "membrane "}[trace.unit]}`;
    return new OverlayPanel({
        host, input: shown.input, name: `${name} ${trace.part}`, title, symbol: trace.part, height: whole ? 130 : 84,
        about: `${name} ${title}${trace.part} of ${list.map((one) => one.member.afferent.name).join(", ")}`,
        line: Number.isFinite(V_th) ? {value: V_th, html: symbolHtml("V_th")} : null,
        versions: list.map((one) => ({trace: one.trace, name: one.member.afferent.name, color: afferentColour(one.member.index),
                                      scale: scales[trace.unit][members.indexOf(one.member)]})),
    });
}

/// Currents, membranes, and what else it has states of, a panel each.
function afferentPanels(host, {afferent, index}, traces, whose = false) {
    return byKind(traces, afferent.netlist).map(([kind, group]) => {
        const {unit} = group[0];
        const title = {A: "current", V: "membrane", nodes: "nodes"}[kind] || group.map((trace) => trace.part).join(", ");
        const hasLine = kind === "V" && Number.isFinite(afferent.V_th);
        group.sort((one, other) => isWhole(other) - isWhole(one));  // the whole first, so that its parts are drawn over it
        return new TracePanel({
            host, input: shown.input, traces: group, name: `${afferent.name} ${title}`, title: whose ? `${afferent.name} ${title}` : title,
            about: `${afferent.name} ${title}: ${group.map((trace) => trace.part).join(", ")}`, height: unit === "A" ? 130 : 110,
            line: hasLine ? {value: afferent.V_th, html: symbolHtml("V_th")} : null,
            series: styles(group, afferentColour(index)),
        });
    });
}

/// [kind, traces]: each of a front by itself; what has one unit together, but a netlist's membrane apart from its other nodes.
function byKind(traces, netlist) {
    const groups = new Map();
    for (const trace of traces) {
        const kind = isFront(trace, traces) ? trace.part : netlist && trace.unit === "V" && !isWhole(trace) ? "nodes" : trace.unit;
        groups.set(kind, [...(groups.get(kind) || []), trace]);
    }
    return [...groups];
}

/// What a sensor, transducer or converter shows: all up to the force as it was read. A panel each.
const isFront = (trace, traces) => traces.indexOf(trace) <= traces.findIndex(({part}) => part === "F_read");

/// Totals and membranes are bold in the afferent's colour; what they are made of is thinner, in its shades and in dashes.
function styles(traces, base) {
    const main = traces.filter(isWhole);
    const bold = [{color: base, width: 2}, {color: mixed(base, colour("ink"), 0.55), width: 2, dash: traces[0].unit === "A" ? [6, 3] : null}];
    const thin = [{color: mixed(base, colour("ink"), 0.55), width: 1}, {color: mixed(base, colour("ink"), 0.2), width: 1, dash: [6, 3]},
                  {color: mixed(base, colour("ink"), 0.7), width: 1.2, dash: [2, 2]}, {color: mixed(base, colour("paper"), 0.35), width: 1}];
    const parts = traces.filter((trace) => !isWhole(trace));
    const pick = (list, k) => list[Math.min(k, list.length - 1)];
    const look = (trace) => (isWhole(trace) ? pick(bold, main.indexOf(trace)) : pick(main.length ? thin : [...bold, ...thin], parts.indexOf(trace)));
    return traces.map((trace) => ({label: trace.part, html: symbolHtml(trace.part), ...look(trace)}));
}
