// Recorded quantities and spike trains. Their numbers stay encoded until they are needed.

import {EncodedArray, decoded, firstAt} from "../base/arrays";
import {Pyramid, Range} from "../base/pyramid";

/// The clock of an input. Sample k, counted from 0, is at t0 + k T (s).
export interface Clock { t0: number; T: number; samples: number }
export interface Phase { name: string; from: number; to: number }

/// The time (s) at which an input ends.
export const endOf = (clock: Clock) => clock.t0 + clock.samples * clock.T;

export interface TraceRecord {
    channel: number; afferent: string | null; quantity: string; unit: string;
    bucket: number;  ///< if it is more than 1, only the minimum and maximum of each `bucket` consecutive samples are known
    count: number;   ///< samples, or pairs of minimum and maximum
    data: EncodedArray;
}

/// One recorded quantity on one channel.
export class Trace {
    readonly afferent: string | null;
    readonly quantity: string;
    readonly unit: string;
    readonly bucket: number;
    private built: Pyramid | null = null;

    constructor(private record: TraceRecord, readonly clock: Clock) {
        [this.afferent, this.quantity, this.unit, this.bucket] = [record.afferent, record.quantity, record.unit, record.bucket];
    }

    /// The values for range queries; entry j is bucket j. Decoded at the first use.
    private get pyramid(): Pyramid { return (this.built = this.built || this.build()); }

    private build(): Pyramid {
        const numbers = decoded<Float32Array>(this.record.data);
        if (this.bucket === 1) return new Pyramid(numbers);
        const lo = new Float32Array(this.record.count), hi = new Float32Array(this.record.count);
        for (let j = 0; j < lo.length; ++j) [lo[j], hi[j]] = [numbers[2 * j], numbers[2 * j + 1]];
        return new Pyramid(lo, hi);
    }

    /// [min, max] of samples k ... l-1, extended to complete buckets.
    range(k: number, l: number): Range { return this.pyramid.range(Math.floor(k / this.bucket), Math.ceil(l / this.bucket)); }
    fullRange(): Range { return this.range(0, this.clock.samples); }
    /// [min, max] in the times from a to b.
    rangeBetween(a: number, b: number): Range {
        const {t0, T, samples} = this.clock;
        return this.range(Math.max(0, Math.floor((a - t0) / T)), Math.min(samples, Math.ceil((b - t0) / T) + 1));
    }

    /// [min, max] of the bucket with the sample nearest to time t (s); both are equal if every sample is known.
    at(t: number): Range {
        const {t0, T, samples} = this.clock, k = Math.max(0, Math.min(samples - 1, Math.round((t - t0) / T)));
        return this.range(k, k + 1);
    }
}

export interface SpikesRecord { afferent: string; channel: number; count: number; times: EncodedArray }

/// The ascending spike times t[k] (s) of one afferent on one channel. The instantaneous frequency at t[k] is f_k = 1 / (t[k+1] - t[k]).
export class Spikes {
    readonly count: number;
    private known: Float64Array | null = null;
    private built: Pyramid | null = null;

    constructor(private record: SpikesRecord | Float64Array | null) { this.count = record instanceof Float64Array ? record.length : record ? record.count : 0; }

    get times(): Float64Array { return (this.known = this.known || this.decodedTimes()); }

    private decodedTimes() {
        if (this.record instanceof Float64Array) return this.record;
        return this.record && this.count ? decoded<Float64Array>(this.record.times) : new Float64Array(0);
    }

    /// The instantaneous frequencies for range queries; entry k is f_k.
    get frequency(): Pyramid { return (this.built = this.built || new Pyramid(this.frequencies())); }

    /// f_k in Hz, one fewer than spikes; NaN where two spike times are equal.
    frequencies(): Float64Array {
        const t = this.times, f = new Float64Array(Math.max(t.length - 1, 0));
        for (let k = 0; k < f.length; ++k) f[k] = t[k + 1] > t[k] ? 1 / (t[k + 1] - t[k]) : NaN;
        return f;
    }

    /// The number of spikes before t.
    before(t: number): number { return firstAt(this.times, t); }

    /// The index of the spike nearest to t; -1 if there are none.
    nearest(t: number): number {
        const k = this.before(t);
        return k === this.count || (k > 0 && t - this.times[k - 1] < this.times[k] - t) ? k - 1 : k;
    }
}
