// Minimum and maximum of any range of a long trace of n entries in O(log n) steps. Level 0 holds the entries themselves; each entry of a
// higher level is the minimum (in `lo`) or maximum (in `hi`) of four entries of the level below.

type Values = Float32Array | Float64Array;
interface Level { lo: Values; hi: Values }
export type Range = [number, number] | [null, null];

export class Pyramid {
    private levels: Level[];

    /// `lo` and `hi`: minimum and maximum of each entry, of equal length. For samples they are the same array. NaN is skipped.
    constructor(lo: Values, hi: Values = lo) {
        this.levels = [{lo, hi}];
        for (let top = this.levels[0]; top.lo.length > 4; this.levels.push(top)) top = levelAbove(top);
    }

    /// Minima and maxima of the entries.
    get base(): Level { return this.levels[0]; }

    /// [min, max] of entries i ... j-1 of level 0, or [null, null] if all are NaN or there are none.
    range(i: number, j: number): Range {
        let min = Infinity, max = -Infinity;
        i = Math.max(i, 0);
        j = Math.min(j, this.levels[0].lo.length);
        for (let level = 0; i < j; ++level, i >>= 2, j >>= 2) {
            const {lo, hi} = this.levels[level], isTop = level === this.levels.length - 1;
            // Entries that do not fill a complete parent are included here; the level above covers the rest.
            const head = isTop ? j : Math.min(j, (i + 3) & ~3), tail = isTop ? j : Math.max(head, j & ~3);
            for (let k = i; k < j; ++k) {
                if (k === head) k = tail;
                if (k === j) break;
                if (lo[k] < min) min = lo[k];
                if (hi[k] > max) max = hi[k];
            }
            i = head;
            j = tail;
        }
        return max < min ? [null, null] : [min, max];
    }
}

function levelAbove({lo, hi}: Level): Level {
    const n = Math.ceil(lo.length / 4), make = lo.constructor as Float32ArrayConstructor;
    const up = {lo: new make(n).fill(Infinity), hi: new make(n).fill(-Infinity)};
    for (let i = 0; i < lo.length; ++i) {
        const j = i >> 2;
        if (lo[i] < up.lo[j]) up.lo[j] = lo[i];
        if (hi[i] > up.hi[j]) up.hi[j] = hi[i];
    }
    return up;
}
