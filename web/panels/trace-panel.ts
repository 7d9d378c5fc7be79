// Force, currents, membranes and node voltages over time, reduced to the resolution of the screen.

import {resolved} from "../base/colours";
import {Child, h} from "../base/dom";
import type {Range} from "../base/pyramid";
import {PREFIXES, prefixPower, quantity, roundTicks, unitText} from "../base/text";
import {Area, Series, csvText} from "../plot/panel";
import type {Pen} from "../plot/pen";
import type {Curve} from "./signals";
import {TimePanel, TimePanelOptions, extentOf, withMargins} from "./time-panel";

export interface TracePanelOptions extends TimePanelOptions {
    traces: Curve[];  ///< of one unit; trace k has the style of series k
    level?: {value: number; label: Child[]} | null;  ///< drawn dashed, such as a threshold
}

export class TracePanel extends TimePanel {
    protected readonly traces: Curve[];
    private level: {value: number; label: Child[]} | null;
    protected extent: [number, number] = [0, 0];
    private power = 0;  // of ten, of the prefix of the axis
    private unitNode = h("span", {class: "unit"});

    constructor(options: TracePanelOptions) {
        super(options);
        this.traces = options.traces;
        this.level = options.level || null;
        this.addTitle(" ", this.unitNode);
        this.setExtent(extentOf(this.traces.map((trace) => trace.fullRange()), this.level ? [this.level.value] : []));
        if (this.level) {
            this.addLegendItem({name: "level", label: this.level.label, colour: "var(--level)", width: 1, dash: [5, 3]}, false);
            this.setValue("level", quantity(this.level.value, this.traces[0].unit, true));
        }
    }

    /// Sets the vertical range of all values, and with it the unit of the axis.
    protected setExtent(extent: [number, number]) {
        const {unit} = this.traces[0];
        this.extent = extent;
        this.power = prefixPower(Math.max(...extent.map(Math.abs)), unit);
        const text = PREFIXES[this.power] + unitText(unit);
        this.unitNode.textContent = text && `(${text})`;
    }

    protected range(isAutoscale: boolean): [number, number] {
        const shown = this.traces.filter((_, k) => this.isVisible(this.series[k]));
        const extent = isAutoscale ? extentOf(shown.map((trace) => trace.rangeBetween(this.view.a, this.view.b))) : this.extent;
        return withMargins(extent, this.isNamed ? 0.24 : 0.07);
    }

    protected verticalTicks(low: number, high: number, pixels: number) {
        const scale = 10 ** this.power, ticks = roundTicks(low / scale, high / scale, pixels / 32);
        return {values: ticks.values.map((v) => v * scale), text: (v: number) => ticks.text(v / scale)};
    }

    protected paint(pen: Pen, area: Area) {
        super.paint(pen, area);
        if (this.level) this.paintLevel(pen, area, this.level.value);
        this.traces.forEach((trace, k) => this.isVisible(this.series[k]) && this.paintTrace(pen, area, trace, this.series[k]));
    }

    private paintLevel(pen: Pen, {x, w}: Area, value: number) {
        const y = Math.round(this.y(value)) + 0.5;
        pen.strokeStyle = resolved("var(--level)");
        pen.lineWidth = 1;
        pen.setLineDash([5, 3]);
        pen.beginPath();
        pen.moveTo(x, y);
        pen.lineTo(x + w, y);
        pen.stroke();
        pen.setLineDash([]);
    }

    private paintTrace(pen: Pen, area: Area, trace: Curve, {colour, width = 1.5, dash}: Series) {
        pen.strokeStyle = resolved(colour);
        pen.lineWidth = width;
        pen.setLineDash(dash || []);
        pen.beginPath();
        const points = pointsOf(trace, this.view.a, this.view.b, area.w);
        let isDown = false;
        for (let k = 0; k < points.length; k += 2) {
            if (Number.isNaN(points[k + 1])) { isDown = false; continue; }
            const [x, y] = [this.x(points[k]), this.y(points[k + 1])];
            if (isDown) pen.lineTo(x, y); else pen.moveTo(x, y);
            isDown = true;
        }
        pen.stroke();
        pen.setLineDash([]);
    }

    protected showValues(t: number) { this.traces.forEach((trace, k) => this.setValue(this.series[k].name, rangeText(trace.at(t), trace.unit))); }

    csv() {
        const {t0, T} = this.clock, {a, b} = this.view, bucket = Math.max(...this.traces.map((trace) => trace.bucket));
        const first = Math.max(0, Math.floor((a - t0) / T / bucket)), last = Math.min(this.clock.samples / bucket, (b - t0) / T / bucket);
        const rows: (number | null)[][] = [];
        for (let k = first; k < last; ++k)
            rows.push([t0 + k * bucket * T, ...this.traces.flatMap((trace) => (bucket === 1 ? [trace.range(k, k + 1)[0]] : trace.range(k * bucket, (k + 1) * bucket)))]);
        const column = ({quantity: name, unit}: Curve) => `${name} (${unit})`;
        return csvText(["time (s)", ...this.traces.flatMap((trace) => (bucket === 1 ? [column(trace)] : [`min ${column(trace)}`, `max ${column(trace)}`]))], rows);
    }
}

/// The points t, v, t, v ... that show a trace from time a to b in `width` pixels. If there are few samples, each is a point. Otherwise each
/// column of about one pixel has two points, the minimum and maximum of its samples; the one nearer to the previous point comes first, so that
/// lines with a slope stay thin. A column's first sample is a multiple of its number of samples, so that the plot does not flicker while it is
/// panned.
export function pointsOf(trace: Curve, a: number, b: number, width: number): number[] {
    const {t0, T, samples} = trace.clock, {bucket} = trace, count = (b - a) / T, pixels = width * (devicePixelRatio || 1);
    const isEach = bucket === 1 && count <= 2 * pixels;
    const column = isEach ? 1 : bucket * Math.max(1, Math.ceil(count / (bucket * pixels)));  // samples per column
    const first = Math.max(0, Math.floor((a - t0) / T / column) - 1), end = Math.min(Math.ceil(samples / column), Math.ceil((b - t0) / T / column) + 2);
    const out: number[] = [];
    let last = 0;
    for (let c = first; c < end; ++c) {
        const t = t0 + (c * column + (column - 1) / 2) * T, [low, high] = trace.range(c * column, (c + 1) * column);
        if (low === null) out.push(t, NaN);
        else if (isEach) out.push(t, low);
        else {
            const isLowNear = Math.abs(last - low) <= Math.abs(last - high);
            out.push(t, isLowNear ? low : high, t, (last = isLowNear ? high : low));
        }
    }
    return out;
}

/// One value as text, or minimum and maximum if their texts differ.
export function rangeText([low, high]: Range, unit: string): string {
    const [first, second] = [quantity(low, unit), quantity(high, unit)];
    return first === second ? first : `${first} … ${second}`;
}
