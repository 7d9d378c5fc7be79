// For overlays of the implementations of one afferent type: matches their quantities, and computes the scales with which they share a panel.

import {CLASSES, classColour, seriesColour} from "../../base/colours";
import {quantity} from "../../base/text";
import type {AfferentData} from "../../data/document";
import {Scale} from "../../panels/overlay-panel";
import type {Spikes, Trace} from "../../panels/signals";

/// `index`: of the afferent in the data of the page.
export interface Member { afferent: AfferentData; index: number; colour: string }
export interface TracedMember extends Member { traces: Trace[] }
export interface AfferentType { name: string; members: Member[] }
export interface Quantity { trace: Trace; member: TracedMember }
/// Threshold and reset voltage of a membrane, V.
export interface MembraneWindow { threshold: number; reset: number }

/// A key that is equal for the same quantity in all implementations: "ia" for the model's I_A and the netlist's i(via), "u" for u and v(u).
/// The current through voltage source via is i(via), so a leading "v" is removed.
function baseQuantity(name: string): string {
    const probed = /^([vi])\((.*)\)$/.exec(name);
    return (probed ? (probed[1] === "i" ? probed[2].replace(/^v/, "") : probed[2]) : name).toLowerCase().replace(/_/g, "");
}

/// True for the total current into a membrane (I, I+, I-) and for a membrane voltage (u, u+, u-), false for components and other quantities.
export const isTotal = (trace: Trace) => (trace.unit === "A" ? /^i[+-]?$/ : /^u[+-]?$/).test(baseQuantity(trace.quantity));

/// True for quantities of the front end (sensor, transducer, converter). `traces` has them first; F_read, the force that the converter reads, is
/// the last of them.
export const isFrontEnd = (trace: Trace, traces: Trace[]) => traces.indexOf(trace) <= traces.findIndex((one) => one.quantity === "F_read");

/// The colour of each afferent: the first of a class has that of its class, the others have the remaining colours.
export function afferentColours(afferents: AfferentData[]): string[] {
    const isFirst = afferents.map(({type}, k) => CLASSES.includes(type) && afferents.findIndex((one) => one.type === type) === k);
    const used = new Set(afferents.filter((_, k) => isFirst[k]).map(({type}) => classColour(type)));
    const free = Array.from({length: 8}, (_, k) => seriesColour(k)).filter((colour) => !used.has(colour));
    let next = 0;
    return afferents.map(({type}, k) => (isFirst[k] ? classColour(type) : free[next++ % free.length]));
}

/// The afferent types in order of first occurrence. The members are the implementations, the reference first: the afferent with the name of the
/// type, then other models, then netlists.
export function afferentTypesOf(afferents: AfferentData[]): AfferentType[] {
    const all = new Map<string, Member[]>(), colours = afferentColours(afferents);
    afferents.forEach((afferent, index) => {
        const name = afferent.type || afferent.name;
        all.set(name, [...(all.get(name) || []), {afferent, index, colour: colours[index]}]);
    });
    const rank = ({afferent}: Member, name: string) => (afferent.netlist ? 2 : afferent.name === name ? 0 : 1);
    return [...all].map(([name, members]) => ({name, members: members.sort((one, other) => rank(one, name) - rank(other, name))}));
}

/// The currents, the totals first, and the membranes that several members have: one list for each.
export function sharedQuantities(members: TracedMember[]): {currents: Quantity[][]; membranes: Quantity[][]} {
    const all = new Map<string, Quantity[]>();
    for (const member of members)
        for (const trace of member.traces.filter((one) => !isFrontEnd(one, member.traces))) {
            const key = trace.unit + baseQuantity(trace.quantity);
            all.set(key, [...(all.get(key) || []), {trace, member}]);
        }
    const shared = [...all.values()].filter((list) => new Set(list.map(({member}) => member)).size > 1);
    return {currents: shared.filter(([{trace}]) => trace.unit === "A").sort(([one], [other]) => Number(isTotal(other.trace)) - Number(isTotal(one.trace))),
            membranes: shared.filter(([{trace}]) => trace.unit === "V" && isTotal(trace))};
}

/// The mean of the positive part of a trace. For a current, this is the part that drives the membrane towards its threshold.
function meanDrive(trace: Trace): number {
    const {lo, hi} = trace.pyramid.base;
    let sum = 0, count = 0;
    for (let k = 0; k < lo.length; ++k) {
        const middle = (lo[k] + hi[k]) / 2;
        if (Number.isFinite(middle)) [sum, count] = [sum + Math.max(middle, 0), count + 1];
    }
    return count ? sum / count : 0;
}

/// Threshold and reset voltage of a membrane: the parameters of the afferent if it has both. Otherwise they are estimated from the minima and maxima
/// of the membrane voltage in the intervals between spikes: their medians over short intervals, because in longer intervals the membrane may be at
/// rest. If an interval has few known samples, the smallest minimum and the largest maximum are used. Null if the afferent fired less than twice, or
/// if the estimates are equal.
export function windowOf({V_th, V_reset}: AfferentData, trace: Trace, spikes: Spikes): MembraneWindow | null {
    if (V_th !== null && V_reset !== null) return {threshold: V_th, reset: V_reset};
    const sample = (t: number) => Math.floor((t - trace.clock.t0) / trace.clock.T), t = spikes.times;
    const intervals = Array.from(t.slice(1), (end, k) => [sample(t[k]), sample(end)]).filter(([i, j]) => j > i);
    if (!intervals.length) return null;
    const longest = 3 * intervals.reduce((least, [i, j]) => Math.min(least, j - i), Infinity);
    const short = intervals.filter(([i, j]) => j - i <= longest).slice(0, 1000);
    const [minima, maxima] = [0, 1].map((end) => short.map(([i, j]) => trace.range(i, j + 1)[end] as number).sort((one, other) => one - other));
    const [low, high] = longest < 24 * trace.bucket ? [minima[0], maxima[maxima.length - 1]] : [minima, maxima].map((all) => all[all.length >> 1]);
    if (!(low < high)) return null;
    return isRising(trace, short, (low + high) / 2) ? {threshold: high, reset: low} : {threshold: low, reset: high};
}

/// True if a membrane rises towards its threshold, false if it falls. It rises if most steps go up in the longest of the intervals [i, j] between
/// spikes. If that has few known samples, it rises if the trace's first value is below `middle`.
function isRising(trace: Trace, intervals: number[][], middle: number): boolean {
    const value = (k: number) => trace.range(k, k + 1)[0] as number;
    const [i, j] = intervals.reduce((longest, one) => (one[1] - one[0] > longest[1] - longest[0] ? one : longest));
    if (j - i < 8 * trace.bucket) return value(0) < middle;
    let up = 0;
    for (let n = i + trace.bucket; n <= j; n += trace.bucket) up += Math.sign(value(n) - value(n - trace.bucket));
    return up > 0;
}

/// The scales of all members. The first member is the reference, with the identity. A member whose property is similar to that of an earlier one
/// shares its scale; the others get a scale from `make`. A member without a property is not scaled. `properties`: one per member.
function sharedScales<P>(properties: (P | null | undefined)[], isSimilar: (one: P, other: P) => boolean, make: (property: P, reference: P) => Scale): Scale[] {
    const scales: Scale[] = [], reference = properties[0];
    properties.forEach((own, k) => {
        const earlier = properties.findIndex((one, n) => n < k && own && one && isSimilar(own, one));
        scales.push(k === 0 || !own || !reference || earlier === 0 ? new Scale() : earlier > 0 ? scales[earlier] : make(own, reference));
    });
    return scales;
}

/// The scale of each member's currents. Currents within a factor of ten share an axis. The others are scaled so that the means of their positive parts
/// are equal: the means of the current that most members have, preferably of the total current.
export function currentScales(members: TracedMember[], currents: Quantity[][]): Scale[] {
    const common = currents.reduce((best, list) => (list.length > best.length ? list : best), []);
    const means = members.map((member) => common.filter((one) => one.member === member).map(({trace}) => meanDrive(trace))[0]);
    return sharedScales(means, (one, other) => one > 0 && other > 0 && one / other < 10 && other / one < 10, (mean, reference) => new Scale(0, reference / mean));
}

/// The scale of each member's membrane, with which thresholds and reset voltages align. `windows`: from windowOf(), one per member.
export function membraneScales(windows: (MembraneWindow | null | undefined)[]): Scale[] {
    const areClose = (one: MembraneWindow, other: MembraneWindow) =>
        Math.abs(one.threshold - other.threshold) + Math.abs(one.reset - other.reset) < 0.2 * Math.abs(other.threshold - other.reset);
    return sharedScales(windows, areClose, (own, reference) => {
        const factor = (reference.threshold - reference.reset) / (own.threshold - own.reset);
        return new Scale(reference.reset - factor * own.reset, factor);
    });
}

/// A note for each implementation that is scaled, which explains the right axes. `currents`, `membranes`: the scales of all members.
export function scaleNotes(members: Member[], currents: Scale[], membranes: Scale[], windows: (MembraneWindow | null | undefined)[]): string[] {
    const first = members[0].afferent.name, text = (value: number, unit: string) => quantity(value, unit, true);
    const current = (scale: Scale) => `Currents are scaled so that ${text(scale.from(1e-6), "A")} corresponds to ${text(1e-6, "A")} in ${first} (equal mean positive currents).`;
    const membrane = (scale: Scale, {threshold, reset}: MembraneWindow) =>
        `${scale.factor < 0 ? "The membrane voltage falls towards threshold, so its axis is inverted" : "The membrane voltage is scaled"}: reset ${text(reset, "V")} ` +
        `corresponds to ${text(windows[0]!.reset, "V")}, threshold ${text(threshold, "V")} to ${text(windows[0]!.threshold, "V")}.`;
    return members.flatMap(({afferent}, k) => {
        const [sameCurrent, sameMembrane] = [currents.indexOf(currents[k]), membranes.indexOf(membranes[k])];
        const notes = [!currents[k].isIdentity && sameCurrent === k ? current(currents[k]) : "", !membranes[k].isIdentity && sameMembrane === k ? membrane(membranes[k], windows[k]!) : ""];
        const shared = [...new Set([sameCurrent, sameMembrane].filter((n) => n < k).map((n) => members[n].afferent.name))];
        if (shared.length) notes.push(`Uses the axes of ${shared.join(", ")}.`);
        if (windows[0] && !windows[k]) notes.push("The membrane is not scaled, because there are fewer than two spikes.");
        const all = notes.filter(Boolean);
        return all.length ? [`${afferent.name}: ${all.join(" ")}`] : [];
    });
}
