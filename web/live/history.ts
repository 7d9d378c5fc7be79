// The last minute of the live page: curves and spike trains that grow at one end and are forgotten at the other.

import {NumberArray, firstAt} from "../base/arrays";
import type {Range} from "../base/pyramid";
import type {Clock, Curve, Train} from "../panels/signals";

export const HISTORY = 60;  // s

/// A curve with a value each T seconds. Only the last `most` values are known, by default those of HISTORY seconds.
export class LiveCurve implements Curve {
    readonly bucket = 1;
    readonly clock: Clock;
    private values: Float32Array;
    private extent: [number, number] = [0, 0];  // of all values so far, so that the axis does not jump

    constructor(readonly quantity: string, readonly unit: string, T: number, readonly afferent: string | null = null, t0 = 0, most = Math.ceil(HISTORY / T)) {
        this.clock = {t0, T, samples: 0};
        this.values = new Float32Array(most);
    }

    /// Appends values; `first`: time of the first, s. A gap before it is NaN.
    append(values: ArrayLike<number>, first = this.clock.t0 + this.clock.samples * this.clock.T) {
        const start = Math.round((first - this.clock.t0) / this.clock.T), n = this.values.length;
        for (let k = Math.max(this.clock.samples, start - n); k < start; ++k) this.values[k % n] = NaN;
        for (let k = 0; k < values.length; ++k) {
            const v = (this.values[(start + k) % n] = values[k]);
            if (v < this.extent[0] || this.clock.samples === 0) this.extent[0] = v;
            if (v > this.extent[1] || this.clock.samples === 0) this.extent[1] = v;
            this.clock.samples = start + k + 1;
        }
    }

    range(k: number, l: number): Range {
        const n = this.values.length, {samples} = this.clock;
        let low = Infinity, high = -Infinity;
        for (let i = Math.max(k, samples - n, 0); i < Math.min(l, samples); ++i) {
            const v = this.values[i % n];
            if (v < low) low = v;
            if (v > high) high = v;
        }
        return high < low ? [null, null] : [low, high];
    }

    fullRange(): Range { return this.clock.samples ? this.extent : [null, null]; }

    rangeBetween(a: number, b: number): Range {
        const {t0, T} = this.clock;
        return this.range(Math.max(0, Math.floor((a - t0) / T)), Math.ceil((b - t0) / T) + 1);
    }

    at(t: number): Range {
        const {t0, T, samples} = this.clock, k = Math.max(0, Math.min(samples - 1, Math.round((t - t0) / T)));
        return this.range(k, k + 1);
    }
}

/// A growing spike train.
export class LiveTrain implements Train {
    times: number[] = [];
    count = 0;  // since the start, with those that are forgotten

    append(t: number) {
        this.count += 1;
        // The spikes of a circuit can come after those of others, but each train is in order.
        this.times.push(t);
    }

    forget(before: number) {
        if (this.times.length && this.times[0] < before) this.times.splice(0, firstAt(this.times, before));
    }

    before(t: number): number { return firstAt(this.times, t); }

    nearest(t: number): number {
        const k = this.before(t);
        return k === this.times.length || (k > 0 && t - this.times[k - 1] < this.times[k] - t) ? k - 1 : k;
    }

    /// The mean rate (Hz) in the last `window` seconds before t.
    rate(t: number, window: number): number { return (this.before(t) - this.before(t - window)) / window; }
}

/// Sorts the spikes of an answer into trains by unit.
export function appendSpikes(trains: LiveTrain[], unit: NumberArray | undefined, time: NumberArray | undefined) {
    for (let k = 0; unit && time && k < unit.length; ++k) trains[unit[k]]?.append(time[k]);
}
