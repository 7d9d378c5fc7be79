// Force, currents, membranes and node voltages over time, reduced to the resolution of the screen.

import {resolved} from "../base/colours";
import {Child, h} from "../base/dom";
import type {Range} from "../base/pyramid";
import {PREFIXES, prefixPower, quantity, roundTicks, unitText} from "../base/text";
import {Area, Series, csvText} from "../plot/panel";
import type {Pen} from "../plot/pen";
import type {Curve} from "./signals";
import {TimePanel, TimePanelOptions, dashedLine, extentOf, withMargins} from "./time-panel";

export interface TracePanelOptions extends TimePanelOptions {
    traces: Curve[];     ///< of one unit; trace k has the style of series k
    owners?: number[];   ///< the index of the series of each trace, if several traces share a series
    level?: {value: number; label: Child[]} | null;  ///< drawn dashed, such as a threshold
}

export class TracePanel extends TimePanel {
    protected readonly traces: Curve[];
    private level: {value: number; label: Child[]} | null;
    protected extent: [number, number] = [0, 0];
    private owners: number[] | null;
    private power = 0;  // of ten, of the prefix of the axis
    private unitNode = h("span", {class: "unit"});
    protected tickPixels = 32;

    constructor(options: TracePanelOptions) {
        super(options);
        [this.traces, this.owners] = [options.traces, options.owners || null];
        this.level = options.level || null;
        this.addTitle(" ", this.unitNode);
        this.setExtent(extentOf(this.traces.map((trace) => trace.fullRange()), this.level ? [this.level.value] : []));
        if (this.level) {
            this.addLegendItem({name: "level", label: this.level.label, colour: "var(--level)", width: 1, dash: [5, 3]}, false);
            this.setValue("level", quantity(this.level.value, this.traces[0].unit, true));
        }
    }

    private styleOf(k: number): Series { return this.series[this.owners ? this.owners[k] : k]; }

    /// Sets the vertical range of all values, and with it the unit of the axis.
    protected setExtent(extent: [number, number]) {
        const {unit} = this.traces[0];
        this.extent = extent;
        this.power = prefixPower(Math.max(...extent.map(Math.abs)), unit);
        const text = PREFIXES[this.power] + unitText(unit);
        this.unitNode.textContent = text && `(${text})`;
    }

    protected range(isAutoscale: boolean): [number, number] {
        const shown = this.traces.filter((_, k) => this.isVisible(this.styleOf(k)));
        const extent = isAutoscale ? extentOf(shown.map((trace) => trace.rangeBetween(this.view.a, this.view.b))) : this.extent;
        return withMargins(extent, this.isNamed ? 0.24 : 0.07);
    }

    protected verticalTicks(low: number, high: number, pixels: number) {
        const scale = 10 ** this.power, ticks = roundTicks(low / scale, high / scale, pixels / this.tickPixels);
        return {values: ticks.values.map((v) => v * scale), text: (v: number) => ticks.text(v / scale)};
    }

    protected paint(pen: Pen, area: Area) {
        super.paint(pen, area);
        const y = this.level && Math.round(this.y(this.level.value)) + 0.5;
        if (y !== null) dashedLine(pen, area.x, y, area.x + area.w, y);
        this.drawn = 0;
        this.traces.forEach((_, k) => this.isVisible(this.styleOf(k)) && this.paintTrace(pen, k));
    }

    /// The points t, v, t, v ... of trace k that are drawn.
    points(k: number) { return pointsOf(this.traces[k], this.view.a, this.view.b, this.area.w); }

    private paintTrace(pen: Pen, k: number) {
        const {colour, width = 1.5, dash} = this.styleOf(k), points = this.points(k);
        pen.strokeStyle = resolved(colour);
        pen.lineWidth = width;
        pen.setLineDash(dash || []);
        pen.beginPath();
        let isDown = false;
        for (let n = 0; n < points.length; n += 2) {
            if (Number.isNaN(points[n + 1])) { isDown = false; continue; }
            const [x, y] = [this.x(points[n]), this.y(points[n + 1])];
            if (isDown) pen.lineTo(x, y); else pen.moveTo(x, y);
            isDown = true;
        }
        pen.globalAlpha = this.owners && this.traces.length > 6 ? 0.55 : 1;
        pen.stroke();
        pen.globalAlpha = 1;
        pen.setLineDash([]);
        this.drawn = Math.max(this.drawn, points.length / 2);
    }

    /// Shows the values of the traces, unless several traces share a series.
    protected showValues(t: number) { if (!this.owners) this.traces.forEach((trace, k) => this.setValue(this.series[k].name, rangeText(trace.at(t), trace.unit))); }

    csv() {
        if (this.owners) return ownersCsv(this.traces, this.traces.map((_, k) => this.styleOf(k).name), this.view.a, this.view.b);
        const names = this.traces.map((trace, k) => (this.series.length > 1 && this.series[k].name !== trace.quantity ? `${this.series[k].name} ${trace.quantity}` : trace.quantity));
        return tracesCsv(this.traces.map((one) => one.source || one), names, this.view.a, this.view.b);
    }
}

/// The values of traces with one clock between two times. If a trace has buckets, the minimum and maximum of all traces over the longest bucket.
export function tracesCsv(traces: Curve[], names: string[], a: number, b: number): string {
    const {t0, T, samples} = traces[0].clock, bucket = Math.max(...traces.map((trace) => trace.bucket));
    const first = Math.max(0, Math.floor((a - t0) / T / bucket)), last = Math.min(samples / bucket, (b - t0) / T / bucket), rows: (number | null)[][] = [];
    for (let k = first; k < last; ++k)
        rows.push([t0 + k * bucket * T, ...traces.flatMap((trace) => (bucket === 1 ? [trace.range(k, k + 1)[0]] : trace.range(k * bucket, (k + 1) * bucket)))]);
    const column = (k: number) => `${names[k]} (${traces[k].unit})`;
    return csvText(["time (s)", ...traces.flatMap((_, k) => (bucket === 1 ? [column(k)] : [`min ${column(k)}`, `max ${column(k)}`]))], rows);
}

/// The values of traces between two times, one after the other, because each has its own clock.
function ownersCsv(traces: Curve[], series: string[], a: number, b: number): string {
    return csvText(["series", "curve", "time (s)", `value (${traces[0].unit})`], traces.flatMap((trace, k) => {
        const {t0, T, samples} = trace.clock, first = Math.max(0, Math.ceil((a - t0) / T)), last = Math.min(samples - 1, Math.floor((b - t0) / T));
        return Array.from({length: Math.max(0, last - first + 1)}, (_, j) => [series[k], trace.quantity, t0 + (first + j) * T, trace.range(first + j, first + j + 1)[0]]);
    }));
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
