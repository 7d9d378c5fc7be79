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

/// The mean of a trace's size.
function meanSize(trace) {
    const {lo, hi} = trace.pyramid.levels[0];
    let sum = 0, count = 0;
    for (let k = 0; k < lo.length; ++k) {
        const middle = (lo[k] + hi[k]) / 2;
        if (Number.isFinite(middle)) [sum, count] = [sum + Math.abs(middle), count + 1];
    }
    return count ? sum / count : 0;
}

/// Where a membrane fires and where it is reset to: as its parameters say; else the ends of its shortest interval between two spikes,
/// on whose way most samples move. Null if it fired less than twice.
function windowOf({afferent}, trace, spikes) {
    if (Number.isFinite(afferent.V_th) && Number.isFinite(afferent.V_reset)) return {fires: afferent.V_th, resets: afferent.V_reset};
    const t = spikes.times, f = spikes.frequency.levels[0].lo;
    if (t.length < 2) return null;
    const k = f.reduce((best, value, one) => (value > f[best] ? one : best), 0);
    const [i, j] = [t[k], t[k + 1]].map((time) => Math.floor((time - trace.t0) / trace.T));
    const [low, high] = trace.range(i, j + 1);
    let rises = 0;
    for (let n = i + 1; n <= j; ++n) rises += Math.sign(trace.range(n, n + 1)[0] - trace.range(n - 1, n)[0]);
    if (low === null || low === high) return null;
    return rises < 0 ? {fires: low, resets: high} : {fires: high, resets: low};
}

/// Values that a tenth and ten times of each other still share an axis.
const alike = (one, other) => one > 0 && other > 0 && one / other < 10 && other / one < 10;

/// Scales of all members, the first one's first. Whoever is like an earlier one shares its scale; the others are given one by `make`.
function sharedScales(members, facts, like, make) {
    const scales = [];
    members.forEach((_, k) => {
        const earlier = facts.findIndex((fact, n) => n < k && facts[k] && fact && like(facts[k], fact));
        scales.push(k === 0 || !facts[k] ? new Scale() : earlier >= 0 ? scales[earlier] : facts[0] ? make(facts[k], facts[0]) : new Scale());
    });
    return scales;
}

/// Currents of another size stand where their mean over the recording is the first one's; of the whole current, if it is shown.
function currentScales(members, currents) {
    const lead = currents.find((list) => isWhole(list[0].trace)) || currents[0] || [];
    const means = members.map((member) => lead.filter((one) => one.member === member).map(({trace}) => meanSize(trace))[0]);
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

/// What the reader must know of the right axes: [sentence].
function scaleSentences(members, currents, membranes, windows) {
    const {name, unit: first} = {name: members[0].afferent.name, unit: windows[0]};
    return members.flatMap(({afferent}, k) => {
        const said = [];
        if (!currents[k].own) said.push(`${quantity(currents[k].from(1e-6), "A", true)} of current stand where ${name} has 1 µA, so that the mean is the same`);
        if (!membranes[k].own)
            said.push(`its membrane ${membranes[k].factor < 0 ? "falls to fire, and is drawn upside down" : "is drawn"}: ` +
                      `${quantity(windows[k].resets, "V", true)}, where a spike leaves it, at ${quantity(first.resets, "V", true)}; ` +
                      `${quantity(windows[k].fires, "V", true)}, where it fires, at ${quantity(first.fires, "V", true)}`);
        return said.length ? [`${afferent.name} by the right axes: ${said.join("; ")}.`] : [];
    });
}
