// A panel over time: bands for the phases of the stimulus, their names, and the common rules of vertical ranges.

import {resolved} from "../base/colours";
import {Panel, PanelOptions, Area} from "../plot/panel";
import type {Pen} from "../plot/pen";
import type {Range} from "../base/pyramid";
import type {Clock, Phase} from "./signals";

export interface TimePanelOptions extends PanelOptions {
    phases?: Phase[];
    clock?: Clock;      ///< of the data; panels take that of each curve
    isNamed?: boolean;  ///< show the names of the phases
    zero?: number | null;  ///< draw a dashed line at this time, such as the contact onset of trials
}

export abstract class TimePanel extends Panel {
    protected readonly isNamed: boolean;
    private phases: Phase[];
    private zero: number | null;

    constructor(options: TimePanelOptions) {
        super(options);
        [this.phases, this.isNamed, this.zero] = [options.phases || [], options.isNamed || false, options.zero ?? null];
    }

    protected paint(pen: Pen, area: Area) {
        this.phases.forEach(({name, from, to}, k) => {
            const left = Math.max(area.x, this.x(from)), right = Math.min(area.x + area.w, this.x(to));
            if (right <= left) return;
            pen.fillStyle = resolved("var(--band)");
            if (k % 2) pen.fillRect(left, area.y, right - left, area.h);
            if (this.isNamed) writeInside(pen, name, left, right, area.y + 12);
        });
        if (this.zero !== null) dashedLine(pen, this.x(this.zero), area.y, this.x(this.zero), area.y + area.h);
    }
}

/// Writes a text centred between two x coordinates, if it fits.
function writeInside(pen: Pen, text: string, left: number, right: number, y: number) {
    pen.textAlign = "center";
    pen.fillStyle = resolved("var(--faint)");
    if (pen.measureText(text).width + 6 < right - left) pen.fillText(text, (left + right) / 2, y);
}

/// A dashed line for a level or an instant.
export function dashedLine(pen: Pen, x1: number, y1: number, x2: number, y2: number) {
    pen.strokeStyle = resolved("var(--level)");
    pen.lineWidth = 1;
    pen.setLineDash([5, 3]);
    pen.beginPath();
    pen.moveTo(x1, y1);
    pen.lineTo(x2, y2);
    pen.stroke();
    pen.setLineDash([]);
}

/// The vertical range of rates from 0 to `high`.
export const fromZero = (high: number): [number, number] => [(high || 1) * -0.04, (high || 1) * 1.08];

/// [min, max] over ranges and further values; null is ignored. [0, 0] if there are none.
export function extentOf(ranges: Range[], more: number[] = []): [number, number] {
    const ends = [...ranges.flat(), ...more].filter((v): v is number => v !== null && Number.isFinite(v));
    return ends.length ? [Math.min(...ends), Math.max(...ends)] : [0, 0];
}

/// Adds margins to a vertical range. `above`: the upper margin as a fraction of the height.
export function withMargins([low, high]: [number, number], above = 0.07): [number, number] {
    const height = high - low || Math.abs(high) * 0.2 || 1;
    return [low - height * 0.07, high + height * above];
}
