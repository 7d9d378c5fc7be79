// Values of many places in consecutive frames of time, and spike trains, as src/report/skin packs them.

import {EncodedArray, decoded} from "../base/arrays";
import type {FramesRecord, TrainsRecord} from "../data/skin";
import {Spikes} from "../panels/signals";

/// Reads variable-length integers (LEB128): seven bits per byte, the lowest bits first; the highest bit is set if more bytes follow.
class PackedNumbers {
    private at = 0;
    private bytes: Uint8Array;
    constructor(array: EncodedArray) { this.bytes = decoded<Uint8Array>(array); }

    byte() { return this.bytes[this.at++]; }

    next() {
        for (let n = 0, scale = 1;; scale *= 128) {
            const byte = this.byte();
            n += (byte & 127) * scale;
            if (byte < 128) return n;
        }
    }
}

/// The nonzero values of places (marks, sites or classes) in each frame. Frame f has entries begin[f] ... begin[f + 1] - 1 of `place` (ascending
/// within a frame) and `value`.
export class Frames {
    readonly count: number;
    readonly width: number;  // of a frame, s
    readonly places: number;
    readonly begin: Uint32Array;
    readonly place: Uint32Array;
    readonly value: Uint32Array;

    constructor({count, width, places, data}: FramesRecord) {
        [this.count, this.width, this.places, this.begin] = [count, width, places, new Uint32Array(count + 1)];
        const source = new PackedNumbers(data), place: number[] = [], value: number[] = [];
        for (let f = 0; f < count; ++f) {
            for (let p = 0; p < places;) {
                const byte = source.byte();
                if (byte === 0) p += source.next();
                else {
                    place.push(p++);
                    value.push(byte < 255 ? byte : source.next());
                }
            }
            this.begin[f + 1] = place.length;
        }
        [this.place, this.value] = [Uint32Array.from(place), Uint32Array.from(value)];
    }

    each(frame: number, call: (place: number, value: number) => void) {
        for (let k = this.begin[frame]; k < this.begin[frame + 1]; ++k) call(this.place[k], this.value[k]);
    }

    /// The sum of the values of each place over all frames.
    totals(): Float64Array {
        const sums = new Float64Array(this.places);
        this.place.forEach((p, k) => { sums[p] += this.value[k]; });
        return sums;
    }
}

export interface Train { afferent: number; spikes: Spikes }

/// The spike trains of the afferents that fired, in order of the afferents. `t0` (s) is the time of tick 0.
export function trainsOf({count, trains, tick, data}: TrainsRecord, t0: number): Train[] {
    const source = new PackedNumbers(data), times = new Float64Array(count), out: Train[] = [];
    for (let k = 0, afferent = 0, at = 0; k < trains; ++k) {
        afferent += source.next();
        const begin = at, end = at + source.next();
        for (let ticks = 0; at < end; ++at) times[at] = t0 + (ticks += source.next()) * tick;
        out.push({afferent: afferent++, spikes: new Spikes(times.subarray(begin, end))});
    }
    return out;
}

/// Spikes in bins of time: finds the marks that fired in an interval without a search in every train.
export class SpikeBins {
    private begin: Uint32Array;
    private marks: Uint32Array;
    private times: Float64Array;

    constructor(trains: Train[], markOf: (afferent: number) => number, private t0: number, private width: number) {
        const bin = (t: number) => Math.max(0, Math.floor((t - t0) / width)), all = trains.map(({spikes}) => spikes.times);
        const last = all.reduce((most, times) => Math.max(most, times[times.length - 1]), t0), count = all.reduce((sum, times) => sum + times.length, 0);
        this.begin = new Uint32Array(bin(last) + 2);
        for (const times of all) for (const t of times) ++this.begin[bin(t) + 1];
        for (let b = 1; b < this.begin.length; ++b) this.begin[b] += this.begin[b - 1];
        const next = this.begin.slice();
        [this.marks, this.times] = [new Uint32Array(count), new Float64Array(count)];
        trains.forEach(({afferent}, k) => {
            const mark = markOf(afferent);
            for (const t of all[k]) {
                const at = next[bin(t)]++;
                [this.marks[at], this.times[at]] = [mark, t];
            }
        });
    }

    /// Calls call(mark, t) for each spike in the times from `from` to `to`, in no order within a bin.
    between(from: number, to: number, call: (mark: number, t: number) => void) {
        const clamp = (b: number) => Math.max(0, Math.min(this.begin.length - 1, b));
        const end = this.begin[clamp(Math.floor((to - this.t0) / this.width) + 1)];
        for (let k = this.begin[clamp(Math.floor((from - this.t0) / this.width))]; k < end; ++k)
            if (this.times[k] > from && this.times[k] <= to) call(this.marks[k], this.times[k]);
    }
}
