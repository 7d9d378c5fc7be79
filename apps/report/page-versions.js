"use strict";
// Versions of one receptor over each other: which of their quantities are the same one, and by what scales they share a panel.

/// What versions call alike: "ia" of I_A and of i(via), "u" of u and of v(u). A current through a source is called after the source.
function quantityOf(part) {
    const probed = part.match(/^([vi])\((.*)\)$/);
    const name = probed ? (probed[1] === "i" ? probed[2].replace(/^v/, "") : probed[2]) : part;
    return name.toLowerCase().replace(/_/g, "");
}

/// A total current or a membrane, and not one of the parts.
const isWhole = ({part, unit}) => (unit === "A" ? /^i[+-]?$/ : /^u[+-]?$/).test(quantityOf(part));

/// [{name, members: [{afferent, index}]}], in order; the first member is what the others are held against. `index` gives the colour.
function receptorsOf(afferents) {
    const all = new Map();
    afferents.forEach((afferent, index) => {
        const name = afferent.receptor || afferent.name;
        all.set(name, [...(all.get(name) || []), {afferent, index}]);
    });
    const rank = ({afferent}, name) => (afferent.netlist ? 2 : afferent.name === name ? 0 : 1);
    return [...all].map(([name, members]) => ({name, members: members.sort((one, other) => rank(one, name) - rank(other, name))}));
}

/// Axis = offset + factor * value: values of a version, where the reference's stand.
class Scale {
    constructor(offset = 0, factor = 1) { Object.assign(this, {offset, factor}); }
    to(value) { return value === null ? null : this.offset + this.factor * value; }
    from(place) { return (place - this.offset) / this.factor; }
    get own() { return this.offset === 0 && this.factor === 1; }
}

/// A trace as it stands on another's axis; at() still gives its own values.
class ScaledTrace {
    constructor(trace, scale) {
        const {part, afferent, unit, bucket, t0, T, samples} = trace;
        Object.assign(this, {trace, scale, part, afferent, unit, bucket, t0, T, samples});
    }
    range(k, l) {
        const [low, high] = this.trace.range(k, l).map((v) => this.scale.to(v));
        return this.scale.factor < 0 ? [high, low] : [low, high];
    }
    whole() { return this.range(0, this.samples); }
    at(t) { return this.trace.at(t); }
}

/// The mean of what is positive of a trace: of a current, what drives the membrane to fire.
function meanDrive(trace) {
    const {lo, hi} = trace.pyramid.levels[0];
    let sum = 0, count = 0;
    for (let k = 0; k < lo.length; ++k) {
        const middle = (lo[k] + hi[k]) / 2;
        if (Number.isFinite(middle)) [sum, count] = [sum + Math.max(middle, 0), count + 1];
    }
    return count ? sum / count : 0;
}

/// Where a membrane fires and where it is reset to: as its parameters say; else the ends of its way between two spikes, the middle ones of the
/// quicker intervals, for in longer ones it may rest; of few samples the outermost ones. Null if it fired less than twice.
function windowOf({afferent}, trace, spikes) {
    if (Number.isFinite(afferent.V_th) && Number.isFinite(afferent.V_reset)) return {fires: afferent.V_th, resets: afferent.V_reset};
    const sample = (t) => Math.floor((t - trace.t0) / trace.T), t = spikes.times;
    const intervals = Array.from(t.slice(1), (end, k) => [sample(t[k]), sample(end)]).filter(([i, j]) => j > i);
    if (!intervals.length) return null;
    const longest = 3 * Math.min(...intervals.map(([i, j]) => j - i));
    const quick = intervals.filter(([i, j]) => j - i <= longest).slice(0, 1000);
    const ends = [0, 1].map((end) => quick.map(([i, j]) => trace.range(i, j + 1)[end]).sort((one, other) => one - other));
    const [low, high] = longest < 24 * trace.bucket ? [ends[0][0], ends[1].at(-1)] : ends.map((all) => all[all.length >> 1]);
    if (!(low < high)) return null;
    return rising(trace, quick, (low + high) / 2) ? {fires: high, resets: low} : {fires: low, resets: high};
}

/// Whether a membrane rises to fire: so go most of its samples between spikes; where these are few, it rests below `middle`.
function rising(trace, intervals, middle) {
    const [i, j] = intervals.reduce((longest, one) => (one[1] - one[0] > longest[1] - longest[0] ? one : longest));
    if (j - i < 8 * trace.bucket) return trace.range(0, 1)[0] < middle;
    let up = 0;
    for (let n = i + trace.bucket; n <= j; n += trace.bucket) up += Math.sign(trace.range(n, n + 1)[0] - trace.range(n - trace.bucket, n - trace.bucket + 1)[0]);
    return up > 0;
}

/// Currents less than ten times each other share an axis.
const alike = (one, other) => one > 0 && other > 0 && one / other < 10 && other / one < 10;

/// Scales of all members, the first one's first. Whoever is like an earlier one shares its scale; the others are given one by `make`.
function sharedScales(members, facts, like, make) {
    const scales = [];
    members.forEach((_, k) => {
        const earlier = facts.findIndex((fact, n) => n < k && facts[k] && fact && like(facts[k], fact));
        scales.push(k === 0 || !facts[k] || !facts[0] ? new Scale() : earlier === 0 ? new Scale() : earlier > 0 ? scales[earlier] : make(facts[k], facts[0]));
    });
    return scales;
}

/// Currents of another size stand where their mean drive is the first one's; of the whole current, if it is shown.
function currentScales(members, currents) {
    const lead = currents.reduce((best, list) => (list.length > best.length ? list : best), []);  // the whole comes first
    const means = members.map((member) => lead.filter((one) => one.member === member).map(({trace}) => meanDrive(trace))[0]);
    return sharedScales(members, means, alike, (own, first) => new Scale(0, first / own));
}

/// Membranes stand so that all fire at one height, and are reset at one.
function membraneScales(members, windows) {
    const near = (one, other) => Math.abs(one.fires - other.fires) + Math.abs(one.resets - other.resets) < 0.2 * Math.abs(other.fires - other.resets);
    return sharedScales(members, windows, near, (own, first) => {
        const factor = (first.fires - first.resets) / (own.fires - own.resets);
        return new Scale(first.resets - factor * own.resets, factor);
    });
}

/// What the reader must know of the right axes, a sentence for each version that does not stand as it is.
function scaleSentences(members, currents, membranes, windows) {
    const first = members[0].afferent.name;
    const text = (value, unit) => quantity(value, unit, true);
    const current = (scale) => `${text(scale.from(1e-6), "A")} stand where ${first} has ${text(1e-6, "A")}, so that the mean of what drives is the same`;
    const membrane = (scale, {fires, resets}) =>
        `its membrane ${scale.factor < 0 ? "falls to fire and is drawn upside down" : "is drawn"}: ${text(resets, "V")}, where a spike leaves it, at ` +
        `${text(windows[0].resets, "V")}; ${text(fires, "V")}, where it fires, at ${text(windows[0].fires, "V")}`;
    return members.flatMap(({afferent}, k) => {
        const earlier = [currents, membranes].map((scales) => scales.indexOf(scales[k]));
        const said = [[currents, current], [membranes, membrane]].flatMap(([scales, say], n) => (scales[k].own || earlier[n] < k ? [] : [say(scales[k], windows[k])]));
        const shared = [...new Set(earlier.filter((n) => n < k).map((n) => members[n].afferent.name))];
        if (shared.length) said.push(`the axes of ${shared.join(", ")}`);
        if (windows[0] && !windows[k]) said.push("its membrane stands at the left as it is, for it fired less than twice");
        return said.length ? [`${afferent.name}: ${said.join("; ")}.`] : [];
    });
}
