// Values of the curves of a plot: their positions on the axes, the points at a place, and their numbers as a file.

import {plainNumber} from "../base/text";
import {csvText} from "../plot/panel";
import {Axis, positionOn, titleOf} from "./axis";
import type {Curve} from "./curves";

/// The curves with positions on the axes instead of values. In a raster, y is the middle of the row; the first row is at the top.
export function placedCurves(curves: Curve[], xAxis: Axis, yAxis: Axis, isRaster: boolean): Curve[] {
    const place = (axis: Axis, values: ArrayLike<number>) => Float64Array.from(values, (v) => positionOn(axis, v));
    return curves.map((curve, k) => {
        const y = isRaster ? new Float64Array(curve.x.length).fill(curves.length - k - 0.5) : place(yAxis, curve.y);
        return {...curve, x: place(xAxis, curve.x), y, bands: curve.bands?.map(({low, high}) => ({low: place(yAxis, low), high: place(yAxis, high)}))};
    });
}

/// The name of a curve. One without a name belongs to the curve before it, such as a fitted line to its points.
export const nameOf = (curves: Curve[], curve: Curve): string => curve.name || curves.slice(0, curves.indexOf(curve)).reverse().find(({name}) => name)?.name || "";

/// The index of the bin that holds x, from the edges of the bins; -1 if there is none.
export const binAt = (edges: ArrayLike<number>, x: number) => Array.from(edges).findIndex((edge, k) => edge <= x && x < edges[k + 1]);

export function nearestIndex(xs: ArrayLike<number>, at: number): number {
    let best = -1;
    for (let k = 0; k < xs.length; ++k) if (best < 0 || Math.abs(xs[k] - at) < Math.abs(xs[best] - at)) best = k;
    return best;
}

/// The points of the curves with positions from a to b, one row each; then the limits of the areas around a curve, if there are any.
export function curvesCsv(curves: Curve[], placed: Curve[], xAxis: Axis, yAxis: Axis, a: number, b: number): string {
    const bands = curves.find((curve) => curve.bands)?.bands || [], title = (axis: Axis) => titleOf({...axis, isLog: false}, 0);
    const known = (value: number | undefined) => (value === undefined || Number.isNaN(value) ? null : plainNumber(value));
    const rows = curves.flatMap((curve, c) => Array.from(curve.x, (x, k) => ({x, k})).filter(({k}) => placed[c].x[k] >= a && placed[c].x[k] <= b)
        .map(({x, k}) => [nameOf(curves, curve), plainNumber(x), known(curve.y[k]), ...(curve.bands || []).flatMap(({low, high}) => [known(low[k]), known(high[k])])]));
    return csvText(["series", title(xAxis), title(yAxis) || "y", ...bands.flatMap((_, k) => [`low ${k + 1}`, `high ${k + 1}`])], rows);
}
