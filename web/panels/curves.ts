// Curves, points, rasters and steps: how they are drawn, in a plot or as a small picture.

import {resolved, seriesColour} from "../base/colours";
import type {Series} from "../plot/panel";
import type {Pen} from "../plot/pen";
import {extentOf} from "./time-panel";

/// line: x is ascending; path: x is in any order; raster: marks at x in a row of its own; steps: a histogram, x has the edges of the bins, one
/// more than y.
export type CurveStyle = "line" | "points" | "path" | "raster" | "steps";

export interface Curve extends Series {
    style: CurveStyle;
    x: ArrayLike<number>;             ///< NaN interrupts a line
    y: ArrayLike<number>;
    bands?: {low: ArrayLike<number>; high: ArrayLike<number>}[];  ///< areas around a line, such as quantiles
    hasPoints?: boolean;              ///< mark the points of a line
    isReference?: boolean;            ///< does not count for the range of the axes
}

/// Pixels of a position on the axes.
export interface Plane { x(position: number): number; y(position: number): number }

export const MARKS = ["●", "■", "▲", "◆"];

/// Colour, and for points also a mark, of series number k.
export const seriesStyle = (k: number, style: CurveStyle): Pick<Series, "colour" | "mark" | "width"> =>
    ({colour: seriesColour(k), mark: style === "points" ? MARKS[k % MARKS.length] : style === "raster" ? "❘" : style === "steps" ? "■" : undefined, width: 1.6});

/// [[smallest, largest] x, [smallest, largest] y] of curves; of the parts with x from a to b, with the points beside them.
export function extentsOf(curves: Curve[], a = -Infinity, b = Infinity): [[number, number], [number, number]] {
    const xs: [number, number][] = [], ys: [number, number][] = [];
    for (const {x, y, bands = [], style} of curves) {
        for (let k = 0; k < x.length; ++k) {
            const isNear = style === "path" || (x[Math.min(k + 1, x.length - 1)] >= a && x[Math.max(k - 1, 0)] <= b);
            if (Number.isNaN(x[k]) || !isNear) continue;
            if (style === "points" && (x[k] < a || x[k] > b)) continue;
            xs.push([x[k], x[k]]);
            if (k < y.length && !Number.isNaN(y[k])) ys.push([y[k], y[k]]);
            for (const {low, high} of bands) if (!Number.isNaN(low[k])) ys.push([low[k], high[k]]);
        }
        if (style === "steps") ys.push([0, 0]);
    }
    return [extentOfPairs(xs), extentOfPairs(ys)];
}

const extentOfPairs = (pairs: [number, number][]): [number, number] =>
    (pairs.length ? pairs.reduce(([low, high], [a, b]) => [Math.min(low, a), Math.max(high, b)], [Infinity, -Infinity]) : extentOf([]));

/// Draws a curve. `rowHeight`: of a row of a raster, pixels; the row of a raster is its y.
export function paintCurve(pen: Pen, curve: Curve, plane: Plane, rowHeight = 18) {
    pen.strokeStyle = pen.fillStyle = resolved(curve.colour);
    pen.lineWidth = curve.width ?? 1.6;
    pen.setLineDash(curve.dash || []);
    const paint = {line: paintLine, path: paintLine, points: paintPoints, raster: paintRaster, steps: paintSteps}[curve.style];
    paint(pen, curve, plane, rowHeight);
    pen.setLineDash([]);
    pen.globalAlpha = 1;
}

function paintLine(pen: Pen, {x, y, bands = [], hasPoints}: Curve, plane: Plane) {
    bands.forEach(({low, high}, k) => {
        pen.globalAlpha = k ? 0.26 : 0.14;
        pen.beginPath();
        for (let i = 0; i < x.length; ++i) pen[i ? "lineTo" : "moveTo"](plane.x(x[i]), plane.y(high[i]));
        for (let i = x.length - 1; i >= 0; --i) pen.lineTo(plane.x(x[i]), plane.y(low[i]));
        pen.fill();
    });
    pen.globalAlpha = 1;
    pen.beginPath();
    let isDown = false;
    for (let k = 0; k < x.length; ++k) {
        const isKnown = !Number.isNaN(x[k]) && !Number.isNaN(y[k]);
        if (isKnown) pen[isDown ? "lineTo" : "moveTo"](plane.x(x[k]), plane.y(y[k]));
        isDown = isKnown;
    }
    pen.stroke();
    if (hasPoints) paintPoints(pen, {x, y, width: 2.2} as Curve, plane);
}

function paintPoints(pen: Pen, {x, y, mark, width = 1.6}: Curve, plane: Plane) {
    const r = (x.length > 300 ? 1.1 : 1.8) * width / 1.6;
    if (x.length > 300) pen.globalAlpha = 0.75;
    pen.beginPath();
    for (let k = 0; k < x.length; ++k)
        if (!Number.isNaN(x[k]) && !Number.isNaN(y[k])) addMark(pen, mark, plane.x(x[k]), plane.y(y[k]), r);
    pen.fill();
}

function addMark(pen: Pen, mark: string | undefined, x: number, y: number, r: number) {
    const corners: Record<string, [number, number][]> = {"■": [[-1, -1], [1, -1], [1, 1], [-1, 1]], "▲": [[0, -1.4], [1.3, 1], [-1.3, 1]], "◆": [[0, -1.5], [1.5, 0], [0, 1.5], [-1.5, 0]]};
    const shape = corners[mark || ""];
    if (!shape) {
        pen.moveTo(x + r * 1.2, y);
        pen.arc(x, y, r * 1.2, 0, 2 * Math.PI);
    } else {
        shape.forEach(([dx, dy], k) => pen[k ? "lineTo" : "moveTo"](x + dx * r, y + dy * r));
        pen.closePath();
    }
}

function paintRaster(pen: Pen, {x, y}: Curve, plane: Plane, rowHeight: number) {
    const height = Math.max(2, 0.76 * rowHeight), width = x.length > 400 ? 0.9 : 1.4;
    for (let k = 0; k < x.length; ++k) pen.fillRect(plane.x(x[k]) - width / 2, plane.y(y[k]) - height / 2, width, height);
}

function paintSteps(pen: Pen, {x, y}: Curve, plane: Plane) {
    pen.beginPath();
    pen.moveTo(plane.x(x[0]), plane.y(0));
    for (let k = 0; k < y.length; ++k) {
        pen.lineTo(plane.x(x[k]), plane.y(y[k]));
        pen.lineTo(plane.x(x[k + 1]), plane.y(y[k]));
    }
    pen.lineTo(plane.x(x[y.length]), plane.y(0));
    pen.globalAlpha = 0.3;
    pen.fill();
    pen.globalAlpha = 1;
    pen.stroke();
}
