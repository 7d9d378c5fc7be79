"use strict";
// Access to the data of the report. Numbers stay base64 text until their trace is shown.

function bytesOf(base64) {
    if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64);
    const text = atob(base64), bytes = new Uint8Array(text.length);
    for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
    return bytes;
}

/// One recorded quantity. Sample k is at t0 + k T. If bucket > 1, only the minimum and maximum of each `bucket` samples are known.
class Trace {
    constructor(record, input) {
        Object.assign(this, {quantity: record.quantity, afferent: record.afferent, unit: record.unit, bucket: record.bucket});
        this.t0 = input.t0;
        this.T = input.T;
        this.samples = input.samples;
        this.record = record;
    }

    get pyramid() {
        if (!this.built) this.built = new Pyramid(...this.decode());
        return this.built;
    }

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

    /// [min, max] at the sample nearest to time t; both are equal if every sample is known.
    at(t) {
        const k = Math.max(0, Math.min(this.samples - 1, Math.round((t - this.t0) / this.T)));
        return this.range(k, k + 1);
    }
}

/// Ascending spike times of one afferent on one channel. The frequency at t[k] is f_k = 1 / (t[k+1] - t[k]).
class Spikes {
    constructor(record) {
        this.record = record;
        this.count = record ? record.count : 0;
    }

    get times() {
        if (!this.decoded) this.decoded = this.count ? new Float64Array(bytesOf(this.record.times).buffer) : new Float64Array(0);
        return this.decoded;
    }

    get frequency() {
        if (!this.built) this.built = new Pyramid(this.frequencies());
        return this.built;
    }

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

    /// New objects on each call, so that the decoded data of one channel can be freed.
    traces(input, channel) {
        return this.data.traces.filter((record) => record.channel === channel.id).map((record) => new Trace(record, input));
    }

    /// The trains shown for an afferent: the afferent itself, or its first copies, with their names.
    members(afferent) {
        const {copies} = this.data;
        return copies ? Array.from({length: copies.shown}, (_, k) => ({name: `${afferent.name}#${k + 1}`})) : [afferent];
    }

    /// The mean rate of all copies of an afferent: {bin (s), values (Hz)}.
    rate(afferent, channel) { return this.data.copies.rates.find((one) => one.afferent === afferent.name && one.channel === channel.id); }

    spikes(afferent, channel) { return this.spikeTrains.get(afferent.name + "\n" + channel.id) || new Spikes(null); }
}

const endOf = (input) => input.t0 + input.samples * input.T;
const phaseAt = (input, t) => input.phases.find((phase) => t >= phase.from && t < phase.to);
