// The shapes of marks, on a canvas or in an SVG file.

import {resolved} from "../base/colours";
import type {Pen} from "../plot/pen";

export function disc(pen: Pen, x: number, y: number, r: number) {
    if (r < 1.2) return pen.fillRect(x - r, y - r, 2 * r, 2 * r);
    pen.beginPath();
    pen.arc(x, y, r, 0, 2 * Math.PI);
    pen.fill();
}

export function circle(pen: Pen, x: number, y: number, r: number) {
    pen.beginPath();
    pen.arc(x, y, r, 0, 2 * Math.PI);
    pen.stroke();
}

/// A ring around a mark, which fades with its level.
export function fadingRing(pen: Pen, x: number, y: number, r: number, level: number, colour: string) {
    pen.strokeStyle = resolved(colour);
    pen.lineWidth = 1.5;
    pen.globalAlpha = Math.max(0, Math.min(1, level));
    circle(pen, x, y, r);
    pen.globalAlpha = 1;
}
