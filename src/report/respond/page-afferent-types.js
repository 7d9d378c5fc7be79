"use strict";
// The figures of an afferent type. If there is one implementation, they show its currents, membranes and other quantities. If there are
// several, the figures overlay each quantity of all of them.

/// The panels of one element of afferentTypesOf().
function afferentTypePanels({name, members}) {
    const traced = members.map((member) => ({...member, traces: shown.traces.filter((trace) => trace.afferent === member.afferent.name)}));
    if (!traced.some(({traces}) => traces.length)) return [];
    const about = ({afferent}) => [report.data.copies ? "copy 1" : "", afferent.composition, afferent.description].filter(Boolean).join(": ");
    if (members.length === 1) {
        const host = section(members[0].afferent.name, about(members[0]), afferentColour(members[0].index));
        return withTimes(traced[0].traces.length ? afferentPanels(host, traced[0], traced[0].traces) : []);
    }
    const host = section(name);
    const list = element(host, "ul", "implementations");
    for (const {afferent, index} of members)
        element(list, "li", "", `<span class="chip" style="background: ${afferentColour(index)}"></span><b>${escaped(afferent.name)}</b> ${escaped(about({afferent}))}`);
    return withTimes(implementationPanels(host, name, traced));
}

/// Shows the time axis below the last panel of a section. Returns the panels.
function withTimes(panels) {
    if (panels.length) panels[panels.length - 1].showTimes();
    return panels;
}

/// Panels that overlay the currents and membranes that several implementations have, then panels of the remaining quantities of each
/// implementation. `members`: {afferent, index, traces} of each implementation.
function implementationPanels(host, name, members) {
    const quantities = new Map();  // unit and base quantity -> [{trace, member}]
    for (const member of members)
        for (const trace of member.traces.filter((one) => !isFrontEnd(one, member.traces))) {
            const key = trace.unit + baseQuantity(trace.quantity);
            quantities.set(key, [...(quantities.get(key) || []), {trace, member}]);
        }
    const shared = [...quantities.values()].filter((list) => new Set(list.map(({member}) => member)).size > 1);
    const currents = shared.filter(([{trace}]) => trace.unit === "A").sort(([one], [other]) => isTotal(other.trace) - isTotal(one.trace));
    const membranes = shared.filter(([{trace}]) => trace.unit === "V" && isTotal(trace));
    const windows = members.map((member) => membranes.flatMap((list) => list.filter((one) => one.member === member))
        .map(({trace}) => windowOf(member, trace, report.spikes(report.members(member.afferent)[0], shown.channel)))[0]);
    const scales = {A: currentScales(members, currents), V: membraneScales(members, windows)};
    for (const text of scaleNotes(members, scales.A, scales.V, windows)) element(host, "p", "note", escaped(text));
    const overlays = [...currents, ...membranes].map((list) => overlay(host, name, members, list, scales));
    const isRemaining = (trace) => ![...currents, ...membranes].flat().some((one) => one.trace === trace);
    return [...overlays, ...members.flatMap((member) => afferentPanels(host, member, member.traces.filter(isRemaining), true))];
}

/// One panel with the same quantity of several implementations. `list`: [{trace, member}]; `scales`: by unit, the scales of all members.
function overlay(host, name, members, list, scales) {
    const [{trace, member}] = list, total = isTotal(trace);
    const V_th = trace.unit === "V" && scales.V[members.indexOf(member)].isIdentity ? member.afferent.V_th : null;
    const title = `${{A: total ? "current " : "", V: "membrane "}[trace.unit]}`;
    return new OverlayPanel({
        host, input: shown.input, name: `${name} ${trace.quantity}`, title, symbol: trace.quantity, height: total ? 130 : 84,
        about: `${name} ${title}${trace.quantity} of ${list.map((one) => one.member.afferent.name).join(", ")}`,
        line: Number.isFinite(V_th) ? {value: V_th, html: symbolHtml("V_th")} : null,
        implementations: list.map((one) => ({trace: one.trace, name: one.member.afferent.name, color: afferentColour(one.member.index),
                                             scale: scales[trace.unit][members.indexOf(one.member)]})),
    });
}

/// The panels of one implementation, one for each kind of quantity: currents, membranes, other states. `withName`: put the afferent's name into the titles.
function afferentPanels(host, {afferent, index}, traces, withName = false) {
    return byKind(traces, afferent.netlist).map(([kind, group]) => {
        const {unit} = group[0];
        const title = {A: "current", V: "membrane", nodes: "nodes"}[kind] || group.map((trace) => trace.quantity).join(", ");
        const hasLine = kind === "V" && Number.isFinite(afferent.V_th);
        group.sort((one, other) => isTotal(other) - isTotal(one));  // totals first, so that components are drawn over them
        return new TracePanel({
            host, input: shown.input, traces: group, name: `${afferent.name} ${title}`, title: withName ? `${afferent.name} ${title}` : title,
            about: `${afferent.name} ${title}: ${group.map((trace) => trace.quantity).join(", ")}`, height: unit === "A" ? 130 : 110,
            line: hasLine ? {value: afferent.V_th, html: symbolHtml("V_th")} : null,
            series: styles(group, afferentColour(index)),
        });
    });
}

/// Groups traces into [kind, traces]: by unit, except that each front end quantity and the nodes of a netlist have their own groups.
function byKind(traces, netlist) {
    const groups = new Map();
    for (const trace of traces) {
        const kind = isFrontEnd(trace, traces) ? trace.quantity : netlist && trace.unit === "V" && !isTotal(trace) ? "nodes" : trace.unit;
        groups.set(kind, [...(groups.get(kind) || []), trace]);
    }
    return [...groups];
}

/// True for quantities of the front end (sensor, transducer, converter). `traces` has them first; F_read, the force that the converter reads,
/// is the last of them.
const isFrontEnd = (trace, traces) => traces.indexOf(trace) <= traces.findIndex(({quantity}) => quantity === "F_read");

/// The series of a panel, one for each trace. Total currents and membranes are thick lines in the colour `base` of the afferent; components
/// are thinner, in shades of it, and some are dashed.
function styles(traces, base) {
    const main = traces.filter(isTotal);
    const bold = [{color: base, width: 2}, {color: mixed(base, colour("ink"), 0.55), width: 2, dash: traces[0].unit === "A" ? [6, 3] : null}];
    const thin = [{color: mixed(base, colour("ink"), 0.55), width: 1}, {color: mixed(base, colour("ink"), 0.2), width: 1, dash: [6, 3]},
                  {color: mixed(base, colour("ink"), 0.7), width: 1.2, dash: [2, 2]}, {color: mixed(base, colour("paper"), 0.35), width: 1}];
    const components = traces.filter((trace) => !isTotal(trace));
    const pick = (list, k) => list[Math.min(k, list.length - 1)];
    const styleOf = (trace) => (isTotal(trace) ? pick(bold, main.indexOf(trace)) : pick(main.length ? thin : [...bold, ...thin], components.indexOf(trace)));
    return traces.map((trace) => ({label: trace.quantity, html: symbolHtml(trace.quantity), ...styleOf(trace)}));
}
