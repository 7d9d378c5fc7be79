"use strict";
// Access to the data of the report. The values of a trace and the times of a spike train stay base64 text until they are needed.

function bytesOf(array) {
    const base64 = typeof array === "string" ? array : Object.values(array)[0];
    if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64);
    const text = atob(base64), bytes = new Uint8Array(text.length);
    for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
    return bytes;
}

/// One recorded quantity on one channel. Sample k, counted from 0, is at t0 + k T (s). If bucket > 1, only the minimum and maximum of each
/// `bucket` consecutive samples are known.
class Trace {
    constructor(record, input) {
        Object.assign(this, {quantity: record.quantity, afferent: record.afferent, unit: record.unit, bucket: record.bucket});
        this.t0 = input.t0;
        this.T = input.T;
        this.samples = input.samples;
        this.record = record;
    }

    /// The values for range queries; entry j is bucket j. Decoded at the first use.
    get pyramid() {
        if (!this.built) this.built = new Pyramid(...this.decode());
        return this.built;
    }

    /// [samples], or [minima, maxima] of the buckets.
    decode() {
        const numbers = new Float32Array(bytesOf(this.record.data).buffer);
        if (this.bucket === 1) return [numbers];
        const lo = new Float32Array(this.record.count), hi = new Float32Array(this.record.count);
        for (let j = 0; j < lo.length; ++j) [lo[j], hi[j]] = [numbers[2 * j], numbers[2 * j + 1]];
        return [lo, hi];
    }

    /// [min, max] of samples k ... l-1, extended to complete buckets.
    range(k, l) { return this.pyramid.range(Math.floor(k / this.bucket), Math.ceil(l / this.bucket)); }

    fullRange() { return this.range(0, this.samples); }

    /// [min, max] of the bucket with the sample nearest to time t (s); both are equal if every sample is known.
    at(t) {
        const k = Math.max(0, Math.min(this.samples - 1, Math.round((t - this.t0) / this.T)));
        return this.range(k, k + 1);
    }
}

/// The ascending spike times t[k] (s) of one afferent on one channel. The instantaneous frequency at t[k] is f_k = 1 / (t[k+1] - t[k]).
/// `record`: from the report's data; null for a train without spikes.
class Spikes {
    constructor(record) {
        this.record = record;
        this.count = record ? record.count : 0;
    }

    get times() {
        if (!this.decoded) this.decoded = this.count ? new Float64Array(bytesOf(this.record.times).buffer) : new Float64Array(0);
        return this.decoded;
    }

    /// The instantaneous frequencies for range queries; entry k is f_k.
    get frequency() {
        if (!this.built) this.built = new Pyramid(this.frequencies());
        return this.built;
    }

    /// f_k in Hz, one fewer than spikes; NaN where two spike times are equal.
    frequencies() {
        const t = this.times, f = new Float64Array(Math.max(t.length - 1, 0));
        for (let k = 0; k < f.length; ++k) f[k] = t[k + 1] > t[k] ? 1 / (t[k + 1] - t[k]) : NaN;
        return f;
    }

    /// The number of spikes before t.
    before(t) {
        let low = 0, high = this.times.length;
        while (low < high) {
            const middle = (low + high) >> 1;
            if (this.times[middle] < t) low = middle + 1;
            else high = middle;
        }
        return low;
    }
}

class Report {
    constructor(data) {
        this.data = data;
        this.spikeTrains = new Map(data.spikes.map((record) => [record.afferent + "\n" + record.channel, new Spikes(record)]));
    }

    /// The traces of a channel. They are new objects on each call, so that the decoded data of the last channel can be freed.
    traces(input, channel) {
        return this.data.traces.filter((record) => record.channel === channel.id).map((record) => new Trace(record, input));
    }

    /// The objects whose spike trains are shown for an afferent: the afferent itself, or its first copies. Each has a name.
    members(afferent) {
        const {copies} = this.data;
        return copies ? Array.from({length: copies.shown}, (_, k) => ({name: `${afferent.name}#${k + 1}`})) : [afferent];
    }

    /// The firing rate of an afferent in bins, the mean over all its copies: {bin (s), values (Hz)}. Only if there are copies.
    rate(afferent, channel) { return this.data.copies.rates.find((one) => one.afferent === afferent.name && one.channel === channel.id); }

    spikes(afferent, channel) { return this.spikeTrains.get(afferent.name + "\n" + channel.id) || new Spikes(null); }
}

/// The time (s) at which an input ends.
const endOf = (input) => input.t0 + input.samples * input.T;
const phaseAt = (input, t) => input.phases.find((phase) => t >= phase.from && t < phase.to);
