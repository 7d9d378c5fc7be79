// The figures of an afferent type. If there is one implementation, they show its currents, membranes and other quantities. If there are several, the
// figures overlay each quantity of all of them.

import {mixed} from "../../base/colours";
import {h} from "../../base/dom";
import {symbol} from "../../base/text";
import {OverlayPanel, Scale} from "../../panels/overlay-panel";
import type {Clock, Phase, Spikes, Trace} from "../../panels/signals";
import {TracePanel} from "../../panels/trace-panel";
import type {Panel, Series} from "../../plot/panel";
import {AfferentType, Member, Quantity, TracedMember, currentScales, isFrontEnd, isTotal, membraneScales, scaleNotes, sharedQuantities, windowOf} from "./implementations";

/// The data that the figures show, of one channel.
export interface ShownChannel { clock: Clock; phases: Phase[]; traces: Trace[]; spikesOf: (member: Member) => Spikes; isCopy: boolean }

export const tracesOf = (shown: ShownChannel, {afferent}: Member) => shown.traces.filter((trace) => trace.afferent === afferent.name);

export function aboutMember({afferent}: Member, isCopy: boolean): string {
    return [isCopy ? "copy 1" : "", afferent.composition, afferent.description].filter(Boolean).join(": ");
}

/// Adds the panels of an afferent type to `host`, and returns them.
export function afferentTypePanels(host: Element, {name, members}: AfferentType, shown: ShownChannel): Panel[] {
    const traced = members.map((member) => ({...member, traces: tracesOf(shown, member)}));
    const panels = members.length === 1 ? memberPanels(host, traced[0], traced[0].traces, shown) : overlayPanels(host, name, traced, shown);
    if (panels.length) panels[panels.length - 1].isBottom = true;
    return panels;
}

/// Panels that overlay the currents and membranes that several implementations have, then panels of the remaining quantities of each.
function overlayPanels(host: Element, name: string, members: TracedMember[], shown: ShownChannel): Panel[] {
    host.append(h("ul", {class: "implementations"}, ...members.map((member) =>
        h("li", {}, h("span", {class: "chip", style: `background: ${member.colour}`}), h("b", {}, member.afferent.name), ` ${aboutMember(member, shown.isCopy)}`))));
    const {currents, membranes} = sharedQuantities(members);
    const windows = members.map((member) => membranes.flatMap((list) => list.filter((one) => one.member === member))
        .map(({trace}) => windowOf(member.afferent, trace, shown.spikesOf(member)))[0]);
    const scales: Record<string, Scale[]> = {A: currentScales(members, currents), V: membraneScales(windows)};
    for (const text of scaleNotes(members, scales.A, scales.V, windows)) host.append(h("p", {class: "note"}, text));
    const overlays = [...currents, ...membranes].map((list) => overlay(host, name, members, list, scales, shown));
    const isShared = (trace: Trace) => [...currents, ...membranes].some((list) => list.some((one) => one.trace === trace));
    return [...overlays, ...members.flatMap((member) => memberPanels(host, member, member.traces.filter((trace) => !isShared(trace)), shown, true))];
}

/// One panel with the same quantity of several implementations. `scales`: by unit, the scales of all members.
function overlay(host: Element, name: string, members: TracedMember[], list: Quantity[], scales: Record<string, Scale[]>, {phases}: ShownChannel): Panel {
    const [{trace, member}] = list, {unit} = trace, isMain = isTotal(trace);
    const title = unit === "V" ? "membrane " : isMain ? "current " : "", scaleOf = (one: TracedMember) => scales[unit][members.indexOf(one)];
    return new OverlayPanel({
        host, phases, name: `${name} ${trace.quantity}`, title: [title, ...symbol(trace.quantity)], height: isMain ? 130 : 84,
        about: `${name} ${title}${trace.quantity} of ${list.map((one) => one.member.afferent.name).join(", ")}`,
        level: unit === "V" && scaleOf(member).isIdentity ? levelOf(member) : null,
        implementations: list.map((one) => ({trace: one.trace, name: one.member.afferent.name, colour: one.member.colour, scale: scaleOf(one.member)})),
    });
}

const levelOf = ({afferent: {V_th}}: Member) => (V_th === null ? null : {value: V_th, label: symbol("V_th")});

/// The panels of one implementation, one for each kind of quantity: currents, membranes, other states. `withName`: name the afferent in the titles.
function memberPanels(host: Element, member: Member, traces: Trace[], {phases}: ShownChannel, withName = false): Panel[] {
    const {afferent} = member;
    return byKind(traces, afferent.netlist).map(([kind, group]) => {
        const {unit} = group[0], names = group.map((trace) => trace.quantity).join(", "), title = ({A: "current", V: "membrane", nodes: "nodes"} as Record<string, string>)[kind] || names;
        group.sort((one, other) => Number(isTotal(other)) - Number(isTotal(one)));  // totals first, so that components are drawn over them
        return new TracePanel({host, phases, traces: group, name: `${afferent.name} ${title}`, title: [withName ? `${afferent.name} ${title}` : title], about: `${afferent.name} ${title}: ${names}`,
                               height: unit === "A" ? 130 : 110, level: kind === "V" ? levelOf(member) : null, series: styles(group, member.colour)});
    });
}

/// Groups traces into [kind, traces]: by unit, except that each front end quantity and the nodes of a netlist have their own groups.
function byKind(traces: Trace[], isNetlist: boolean): [string, Trace[]][] {
    const groups = new Map<string, Trace[]>();
    for (const trace of traces) {
        const kind = isFrontEnd(trace, traces) ? trace.quantity : isNetlist && trace.unit === "V" && !isTotal(trace) ? "nodes" : trace.unit;
        groups.set(kind, [...(groups.get(kind) || []), trace]);
    }
    return [...groups];
}

/// The series of a panel, one for each trace. Total currents and membranes are thick lines in the colour `base` of the afferent; components are thinner,
/// in shades of it, and some are dashed.
function styles(traces: Trace[], base: string): Series[] {
    const ink = (part: number) => mixed(base, "var(--ink)", part), main = traces.filter(isTotal), components = traces.filter((trace) => !isTotal(trace));
    const bold = [{colour: base, width: 2}, {colour: ink(0.55), width: 2, dash: traces[0].unit === "A" ? [6, 3] : undefined}];
    const thin = [{colour: ink(0.55), width: 1}, {colour: ink(0.2), width: 1, dash: [6, 3]}, {colour: ink(0.7), width: 1.2, dash: [2, 2]}, {colour: mixed(base, "var(--paper)", 0.35), width: 1}];
    const pick = <T>(list: T[], k: number) => list[Math.min(k, list.length - 1)];
    return traces.map((trace) => ({name: trace.quantity, label: symbol(trace.quantity),
        ...(isTotal(trace) ? pick(bold, main.indexOf(trace)) : pick(main.length ? thin : [...bold, ...thin], components.indexOf(trace)))}));
}
