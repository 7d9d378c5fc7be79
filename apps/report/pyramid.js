"use strict";
// Least and greatest value of any stretch of a long trace, in a few dozen steps however long the stretch.
// Level 0 is the samples; each entry of the next level is the least (greatest) of four entries below it.

class Pyramid {
    /// `lo` and `hi` are typed arrays of one length; the same array twice for plain samples. NaN counts as no sample.
    constructor(lo, hi = lo) {
        this.levels = [{lo, hi}];
        for (let top = this.levels[0]; top.lo.length > 4; this.levels.push(top)) top = Pyramid.above(top);
    }

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

    /// [least, greatest] of entries i ... j-1, or [null, null] where there are none.
    range(i, j) {
        let least = Infinity, greatest = -Infinity;
        i = Math.max(i, 0);
        j = Math.min(j, this.levels[0].lo.length);
        for (let level = 0; i < j; ++level, i >>= 2, j >>= 2) {
            const {lo, hi} = this.levels[level];
            const top = level === this.levels.length - 1;
            const see = (k) => {
                if (lo[k] < least) least = lo[k];
                if (hi[k] > greatest) greatest = hi[k];
            };
            // Entries that do not fill a whole parent are looked at here; the rest is left to the level above.
            while (i < j && (top || i % 4)) see(i++);
            while (i < j && j % 4) see(--j);
        }
        return greatest < least ? [null, null] : [least, greatest];
    }
}
