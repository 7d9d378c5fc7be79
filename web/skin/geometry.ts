// The shape of a skin and the places of its afferents. Lengths are m, x to the right, y away from the wrist.

export type Box = [number, number, number, number];  // left, low, right, high
export type Places = Float32Array;                   // x, y, x, y ...

/// A mark is a dot of a map: one afferent, or some neighbours of one class. The class has the marks first ... end - 1.
export interface SkinClass { name: string; colour: string; first: number; end: number }

export interface SkinGeometry {
    outline: Places[];  ///< closed polygons around the skin; empty if the sites are separate sensors
    borders: Places[];  ///< closed polygons around the regions
    sites: Places;
    side: number;       ///< of the square of a site
    marks: Places;
    classes: SkinClass[];
}

export const emptyBox = (): Box => [Infinity, Infinity, -Infinity, -Infinity];
export const grown = ([x0, y0, x1, y1]: Box, by: number): Box => [x0 - by, y0 - by, x1 + by, y1 + by];
export const joined = (a: Box, b: Box): Box => [Math.min(a[0], b[0]), Math.min(a[1], b[1]), Math.max(a[2], b[2]), Math.max(a[3], b[3])];

/// The box of those places whose index satisfies `wanted`. Not finite if there are none.
export function boxOf(places: Places, wanted: (k: number) => boolean = () => true): Box {
    const box = emptyBox();
    for (let k = 0; 2 * k < places.length; ++k) {
        if (!wanted(k)) continue;
        const x = places[2 * k], y = places[2 * k + 1];
        [box[0], box[1], box[2], box[3]] = [Math.min(box[0], x), Math.min(box[1], y), Math.max(box[2], x), Math.max(box[3], y)];
    }
    return box;
}

/// The median distance (m) of a place to its nearest neighbour elsewhere, estimated from about 60 places; 5 mm if there are fewer than two.
export function spacing(places: Places): number {
    const count = places.length / 2, step = Math.max(1, Math.floor(count / 60)), found: number[] = [];
    for (let i = 0; i < count; i += step) {
        let nearest = Infinity;
        for (let j = 0; j < count; ++j) nearest = Math.min(nearest, Math.hypot(places[2 * i] - places[2 * j], places[2 * i + 1] - places[2 * j + 1]) || Infinity);
        found.push(nearest);
    }
    const middle = found.sort((a, b) => a - b)[Math.floor(found.length / 2)];
    return Number.isFinite(middle) ? middle : 5e-3;
}

/// Places of which no two are equal: those at one place are moved to a circle around it, whose radius is `reach` of the distance to the next place.
export function fanned(places: Places, reach = 0.26): Places {
    const at = new Map<string, number[]>();
    for (let k = 0; 2 * k < places.length; ++k) {
        const key = `${places[2 * k]} ${places[2 * k + 1]}`, same = at.get(key);
        if (same) same.push(k);
        else at.set(key, [k]);
    }
    if (2 * at.size === places.length) return places;
    const out = places.slice(), radius = reach * spacing(places);
    for (const same of at.values())
        same.forEach((k, n) => {
            if (same.length < 2) return;
            const angle = Math.PI * (2 * n / same.length + (same.length === 2 ? 1 : 0.5));
            out[2 * k] += radius * Math.cos(angle);
            out[2 * k + 1] += radius * Math.sin(angle);
        });
    return out;
}
