// Recorded quantities and spike trains. Their numbers stay encoded until they are needed.

import {EncodedArray, decoded, firstAt} from "../base/arrays";
import {Pyramid, Range} from "../base/pyramid";

/// The clock of an input. Sample k, counted from 0, is at t0 + k T (s).
export interface Clock { t0: number; T: number; samples: number }
export interface Phase { name: string; from: number; to: number }

/// The time (s) at which an input ends.
export const endOf = (clock: Clock) => clock.t0 + clock.samples * clock.T;

/// A quantity over time that a panel can draw.
export interface Curve {
    readonly afferent: string | null;
    readonly quantity: string;
    readonly unit: string;
    readonly bucket: number;
    readonly clock: Clock;
    /// [min, max] of samples k ... l-1.
    range(k: number, l: number): Range;
    fullRange(): Range;
    /// [min, max] in the times from a to b (s).
    rangeBetween(a: number, b: number): Range;
    /// [min, max] near the time t (s).
    at(t: number): Range;
    /// The curve in its own unit, if this one is scaled.
    readonly source?: Curve;
}

/// The spike times of one afferent, s, in ascending order.
export interface Train {
    readonly count: number;
    readonly times: ArrayLike<number>;
    before(t: number): number;
    nearest(t: number): number;
}

export interface TraceRecord {
    channel: number; afferent: string | null; quantity: string; unit: string;
    bucket: number;  ///< if it is more than 1, only the minimum and maximum of each `bucket` consecutive samples are known
    count: number;   ///< samples, or pairs of minimum and maximum
    data: EncodedArray;
}

/// One recorded quantity on one channel.
export class Trace implements Curve {
    readonly afferent: string | null;
    readonly quantity: string;
    readonly unit: string;
    readonly bucket: number;
    private built: Pyramid | null = null;

    constructor(protected readonly record: TraceRecord, readonly clock: Clock) {
        [this.afferent, this.quantity, this.unit, this.bucket] = [record.afferent, record.quantity, record.unit, record.bucket];
    }

    /// The values for range queries; entry j is bucket j. Decoded at the first use.
    get pyramid(): Pyramid { return (this.built = this.built || this.build()); }

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
export class Spikes implements Train {
    readonly count: number;
    private known: Float64Array | null;
    private built: Pyramid | null = null;

    /// `source`: from the data of a page, or the times themselves; null for a train without spikes.
    constructor(private source: {count: number; times: EncodedArray} | Float64Array | null) {
        this.known = source instanceof Float64Array ? source : source && source.count ? null : new Float64Array(0);
        this.count = source instanceof Float64Array ? source.length : source ? source.count : 0;
    }

    get times(): Float64Array { return (this.known = this.known || decoded<Float64Array>((this.source as SpikesRecord).times)); }

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
