"use strict";
// For overlays of the implementations of one afferent type: matches their quantities, and computes the scales with which they share a panel.

/// A key that is equal for the same quantity in all implementations: "ia" for the model's I_A and the netlist's i(via), "u" for u and v(u).
/// The current through voltage source via is i(via), so a leading "v" is removed.
function baseQuantity(quantity) {
    const probed = quantity.match(/^([vi])\((.*)\)$/);
    const name = probed ? (probed[1] === "i" ? probed[2].replace(/^v/, "") : probed[2]) : quantity;
    return name.toLowerCase().replace(/_/g, "");
}

/// True for the total current into a membrane (I, I+, I-) and for a membrane voltage (u, u+, u-), false for components and other quantities.
const isTotal = ({quantity, unit}) => (unit === "A" ? /^i[+-]?$/ : /^u[+-]?$/).test(baseQuantity(quantity));

/// The afferent types in order of first occurrence: [{name, members: [{afferent, index}]}]. The members are the implementations, the reference
/// first: the afferent with the name of the type, then other models, then netlists. `index`, the afferent's index in `afferents`, selects
/// the colour.
function afferentTypesOf(afferents) {
    const all = new Map();
    afferents.forEach((afferent, index) => {
        const name = afferent.type || afferent.name;
        all.set(name, [...(all.get(name) || []), {afferent, index}]);
    });
    const rank = ({afferent}, name) => (afferent.netlist ? 2 : afferent.name === name ? 0 : 1);
    return [...all].map(([name, members]) => ({name, members: members.sort((one, other) => rank(one, name) - rank(other, name))}));
}

/// Maps values of an implementation to the axis of the reference: offset + factor * value.
class Scale {
    constructor(offset = 0, factor = 1) { Object.assign(this, {offset, factor}); }
    to(value) { return value === null ? null : this.offset + this.factor * value; }
    from(axisValue) { return (axisValue - this.offset) / this.factor; }
    get isIdentity() { return this.offset === 0 && this.factor === 1; }
}

/// A trace whose ranges are scaled to the axis of the reference; at() returns unscaled values, for the legend.
class ScaledTrace {
    constructor(trace, scale) {
        const {quantity, afferent, unit, bucket, t0, T, samples} = trace;
        Object.assign(this, {trace, scale, quantity, afferent, unit, bucket, t0, T, samples});
    }
    range(k, l) {
        const [low, high] = this.trace.range(k, l).map((v) => this.scale.to(v));
        return this.scale.factor < 0 ? [high, low] : [low, high];
    }
    fullRange() { return this.range(0, this.samples); }
    at(t) { return this.trace.at(t); }
}

/// The mean of the positive part of a trace. For a current, this is the part that drives the membrane towards its threshold.
function meanDrive(trace) {
    const {lo, hi} = trace.pyramid.levels[0];
    let sum = 0, count = 0;
    for (let k = 0; k < lo.length; ++k) {
        const middle = (lo[k] + hi[k]) / 2;
        if (Number.isFinite(middle)) [sum, count] = [sum + Math.max(middle, 0), count + 1];
    }
    return count ? sum / count : 0;
}

/// Threshold and reset voltage of a membrane, V: the parameters of the afferent if it has both. Otherwise they are estimated from the minima
/// and maxima of the membrane voltage in the intervals between spikes: their medians over short intervals, because in longer intervals the
/// membrane may be at rest. If an interval has few known samples, the smallest minimum and the largest maximum are used. Null if the
/// afferent fired less than twice, or if the estimates are equal.
function windowOf({afferent}, trace, spikes) {
    if (Number.isFinite(afferent.V_th) && Number.isFinite(afferent.V_reset)) return {threshold: afferent.V_th, reset: afferent.V_reset};
    const sample = (t) => Math.floor((t - trace.t0) / trace.T), t = spikes.times;
    const intervals = Array.from(t.slice(1), (end, k) => [sample(t[k]), sample(end)]).filter(([i, j]) => j > i);
    if (!intervals.length) return null;
    const longest = 3 * Math.min(...intervals.map(([i, j]) => j - i));
    const shortIntervals = intervals.filter(([i, j]) => j - i <= longest).slice(0, 1000);
    const extremes = [0, 1].map((end) => shortIntervals.map(([i, j]) => trace.range(i, j + 1)[end]).sort((one, other) => one - other));
    // extremes[0] are the sorted minima, extremes[1] the sorted maxima
    const [low, high] = longest < 24 * trace.bucket ? [extremes[0][0], extremes[1].at(-1)] : extremes.map((all) => all[all.length >> 1]);
    if (!(low < high)) return null;
    return isRising(trace, shortIntervals, (low + high) / 2) ? {threshold: high, reset: low} : {threshold: low, reset: high};
}

/// True if a membrane rises towards its threshold, false if it falls. It rises if most steps go up in the longest of the intervals [i, j]
/// between spikes. If that has few known samples, it rises if the trace's first value is below `middle`.
function isRising(trace, intervals, middle) {
    const [i, j] = intervals.reduce((longest, one) => (one[1] - one[0] > longest[1] - longest[0] ? one : longest));
    if (j - i < 8 * trace.bucket) return trace.range(0, 1)[0] < middle;
    let up = 0;
    for (let n = i + trace.bucket; n <= j; n += trace.bucket) up += Math.sign(trace.range(n, n + 1)[0] - trace.range(n - trace.bucket, n - trace.bucket + 1)[0]);
    return up > 0;
}

/// Currents within a factor of ten share an axis.
const areSimilar = (one, other) => one > 0 && other > 0 && one / other < 10 && other / one < 10;

/// The scales of all members. The first member is the reference, with the identity. A member whose property is similar to that of an earlier
/// one shares its scale; the others get a scale from `make`. A member without a property is not scaled. `properties`: one per member.
function sharedScales(members, properties, isSimilar, make) {
    const scales = [];
    members.forEach((_, k) => {
        const earlier = properties.findIndex((one, n) => n < k && properties[k] && one && isSimilar(properties[k], one));
        scales.push(k === 0 || !properties[k] || !properties[0] ? new Scale() : earlier === 0 ? new Scale() : earlier > 0 ? scales[earlier] : make(properties[k], properties[0]));
    });
    return scales;
}

/// The scale of each member's currents. Currents of a different magnitude are scaled so that the means of their positive parts are equal.
/// The means are those of the total current if several implementations have it. `currents`: lists of [{trace, member}], one per quantity.
function currentScales(members, currents) {
    // the current that most implementations have; the total current comes first in `currents` and is preferred
    const common = currents.reduce((best, list) => (list.length > best.length ? list : best), []);
    const means = members.map((member) => common.filter((one) => one.member === member).map(({trace}) => meanDrive(trace))[0]);
    return sharedScales(members, means, areSimilar, (mean, reference) => new Scale(0, reference / mean));
}

/// The scale of each member's membrane, with which thresholds and reset voltages align. `windows`: from windowOf(), one per member.
function membraneScales(members, windows) {
    const areClose = (one, other) => Math.abs(one.threshold - other.threshold) + Math.abs(one.reset - other.reset) < 0.2 * Math.abs(other.threshold - other.reset);
    return sharedScales(members, windows, areClose, (membrane, reference) => {
        const factor = (reference.threshold - reference.reset) / (membrane.threshold - membrane.reset);
        return new Scale(reference.reset - factor * membrane.reset, factor);
    });
}

/// A note for each implementation that is scaled, which explains the right axes. `currents`, `membranes`: the scales of all members.
function scaleNotes(members, currents, membranes, windows) {
    const first = members[0].afferent.name;
    const text = (value, unit) => quantity(value, unit, true);
    const current = (scale) => `Currents are scaled so that ${text(scale.from(1e-6), "A")} corresponds to ${text(1e-6, "A")} in ${first} (equal mean positive currents).`;
    const membrane = (scale, {threshold, reset}) =>
        `${scale.factor < 0 ? "The membrane voltage falls towards threshold, so its axis is inverted" : "The membrane voltage is scaled"}: reset ${text(reset, "V")} ` +
        `corresponds to ${text(windows[0].reset, "V")}, threshold ${text(threshold, "V")} to ${text(windows[0].threshold, "V")}.`;
    return members.flatMap(({afferent}, k) => {
        const earlier = [currents, membranes].map((scales) => scales.indexOf(scales[k]));
        const notes = [[currents, current], [membranes, membrane]].flatMap(([scales, note], n) => (scales[k].isIdentity || earlier[n] < k ? [] : [note(scales[k], windows[k])]));
        const shared = [...new Set(earlier.filter((n) => n < k).map((n) => members[n].afferent.name))];
        if (shared.length) notes.push(`Uses the axes of ${shared.join(", ")}.`);
        if (windows[0] && !windows[k]) notes.push("The membrane is not scaled, because there are fewer than two spikes.");
        return notes.length ? [`${afferent.name}: ${notes.join(" ")}`] : [];
    });
}
