"use strict";
// Overlays of the implementations of one afferent type: matches their quantities, and computes the scales with which they share a panel.

/// A key that is equal for the same quantity in all implementations: "ia" for I_A and i(via), "u" for u and v(u). A current through a source
/// is named after the source.
function baseQuantity(quantity) {
    const probed = quantity.match(/^([vi])\((.*)\)$/);
    const name = probed ? (probed[1] === "i" ? probed[2].replace(/^v/, "") : probed[2]) : quantity;
    return name.toLowerCase().replace(/_/g, "");
}

/// True for a total current or a membrane, false for components.
const isTotal = ({quantity, unit}) => (unit === "A" ? /^i[+-]?$/ : /^u[+-]?$/).test(baseQuantity(quantity));

/// [{name, members: [{afferent, index}]}], in order. The first member is the reference. `index` selects the colour.
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

/// A trace scaled to the axis of the reference; at() returns unscaled values.
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

/// The mean of the positive part of a trace; for a current, the part that drives the membrane to fire.
function meanDrive(trace) {
    const {lo, hi} = trace.pyramid.levels[0];
    let sum = 0, count = 0;
    for (let k = 0; k < lo.length; ++k) {
        const middle = (lo[k] + hi[k]) / 2;
        if (Number.isFinite(middle)) [sum, count] = [sum + Math.max(middle, 0), count + 1];
    }
    return count ? sum / count : 0;
}

/// Threshold and reset voltage of a membrane, V: the parameters of the afferent if it has both. Otherwise they are estimated from the
/// extremes between spikes: the medians over short intervals, because in longer intervals the membrane may be at rest. With few samples the
/// outermost values are used. Null if the afferent fired less than twice.
function windowOf({afferent}, trace, spikes) {
    if (Number.isFinite(afferent.V_th) && Number.isFinite(afferent.V_reset)) return {threshold: afferent.V_th, reset: afferent.V_reset};
    const sample = (t) => Math.floor((t - trace.t0) / trace.T), t = spikes.times;
    const intervals = Array.from(t.slice(1), (end, k) => [sample(t[k]), sample(end)]).filter(([i, j]) => j > i);
    if (!intervals.length) return null;
    const longest = 3 * Math.min(...intervals.map(([i, j]) => j - i));
    const shortIntervals = intervals.filter(([i, j]) => j - i <= longest).slice(0, 1000);
    const extremes = [0, 1].map((end) => shortIntervals.map(([i, j]) => trace.range(i, j + 1)[end]).sort((one, other) => one - other));
    const [low, high] = longest < 24 * trace.bucket ? [extremes[0][0], extremes[1].at(-1)] : extremes.map((all) => all[all.length >> 1]);
    if (!(low < high)) return null;
    return isRising(trace, shortIntervals, (low + high) / 2) ? {threshold: high, reset: low} : {threshold: low, reset: high};
}

/// True if a membrane rises towards its threshold: most steps between spikes go up, or, with few samples, its first value is below `middle`.
function isRising(trace, intervals, middle) {
    const [i, j] = intervals.reduce((longest, one) => (one[1] - one[0] > longest[1] - longest[0] ? one : longest));
    if (j - i < 8 * trace.bucket) return trace.range(0, 1)[0] < middle;
    let up = 0;
    for (let n = i + trace.bucket; n <= j; n += trace.bucket) up += Math.sign(trace.range(n, n + 1)[0] - trace.range(n - trace.bucket, n - trace.bucket + 1)[0]);
    return up > 0;
}

/// Currents within a factor of ten share an axis.
const areSimilar = (one, other) => one > 0 && other > 0 && one / other < 10 && other / one < 10;

/// Scales of all members; the first is the reference. A member similar to an earlier one shares its scale; others get a scale from `make`.
function sharedScales(members, properties, isSimilar, make) {
    const scales = [];
    members.forEach((_, k) => {
        const earlier = properties.findIndex((one, n) => n < k && properties[k] && one && isSimilar(properties[k], one));
        scales.push(k === 0 || !properties[k] || !properties[0] ? new Scale() : earlier === 0 ? new Scale() : earlier > 0 ? scales[earlier] : make(properties[k], properties[0]));
    });
    return scales;
}

/// Scales currents of a different magnitude so that their mean positive currents are equal. The total current is used if it is shown.
function currentScales(members, currents) {
    // the current that most implementations have; the total current comes first
    const common = currents.reduce((best, list) => (list.length > best.length ? list : best), []);
    const means = members.map((member) => common.filter((one) => one.member === member).map(({trace}) => meanDrive(trace))[0]);
    return sharedScales(members, means, areSimilar, (mean, reference) => new Scale(0, reference / mean));
}

/// Scales membranes so that their thresholds align, and their reset values, too.
function membraneScales(members, windows) {
    const areClose = (one, other) => Math.abs(one.threshold - other.threshold) + Math.abs(one.reset - other.reset) < 0.2 * Math.abs(other.threshold - other.reset);
    return sharedScales(members, windows, areClose, (membrane, reference) => {
        const factor = (reference.threshold - reference.reset) / (membrane.threshold - membrane.reset);
        return new Scale(reference.reset - factor * membrane.reset, factor);
    });
}

/// Explains the right axes: a note for each implementation that is scaled.
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
