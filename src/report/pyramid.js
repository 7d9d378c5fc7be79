"use strict";
// Minimum and maximum of any range of a long trace of n entries in O(log n) steps. Level 0 holds the entries themselves; each entry of a
// higher level is the minimum (in `lo`) or maximum (in `hi`) of four entries of the level below.

class Pyramid {
    /// `lo` and `hi`: minimum and maximum of each entry, typed arrays of equal length. For samples they are the same array. NaN is skipped.
    constructor(lo, hi = lo) {
        this.levels = [{lo, hi}];
        for (let top = this.levels[0]; top.lo.length > 4; this.levels.push(top)) top = Pyramid.above(top);
    }

    /// The level above a level.
    static above({lo, hi}) {
        const n = Math.ceil(lo.length / 4);
        const up = {lo: new lo.constructor(n).fill(Infinity), hi: new hi.constructor(n).fill(-Infinity)};
        for (let i = 0; i < lo.length; ++i) {
            const j = i >> 2;
            if (lo[i] < up.lo[j]) up.lo[j] = lo[i];
            if (hi[i] > up.hi[j]) up.hi[j] = hi[i];
        }
        return up;
    }

    /// [min, max] of entries i ... j-1 of level 0, or [null, null] if all are NaN or there are none.
    range(i, j) {
        let min = Infinity, max = -Infinity;
        i = Math.max(i, 0);
        j = Math.min(j, this.levels[0].lo.length);
        for (let level = 0; i < j; ++level, i >>= 2, j >>= 2) {
            const {lo, hi} = this.levels[level];
            const top = level === this.levels.length - 1;
            const include = (k) => {
                if (lo[k] < min) min = lo[k];
                if (hi[k] > max) max = hi[k];
            };
            // Entries that do not fill a complete parent are included here; the level above covers the rest.
            while (i < j && (top || i % 4)) include(i++);
            while (i < j && j % 4) include(--j);
        }
        return max < min ? [null, null] : [min, max];
    }
}
