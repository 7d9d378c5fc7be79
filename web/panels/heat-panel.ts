// A quantity of many channels over time: one row each, values as colours. The effort depends on the number of pixels, not of samples.

import {components, resolved} from "../base/colours";
import {h} from "../base/dom";
import {fixedText, quantity, Ticks} from "../base/text";
import type {Area} from "../plot/panel";
import type {Pen} from "../plot/pen";
import type {Curve} from "./signals";
import {PanelRow, RowsOptions, RowsPanel} from "./rows-panel";
import {extentOf} from "./time-panel";
import {rangeText, tracesCsv} from "./trace-panel";

/// All rows have one unit and one clock.
export interface HeatRow extends PanelRow { trace: Curve }

/// The height in pixels that suits a number of rows.
export const heatHeight = (rows: number) => Math.max(60, Math.min(14, 112 / rows) * rows);

/// The background is 0, or the smallest value if all are positive; each pixel shows the value farthest from it.
export class HeatPanel<R extends HeatRow = HeatRow> extends RowsPanel<R> {
    private extent: [number, number];
    private scaleBar = h("canvas", {class: "colour-scale", width: 64, height: 1, "aria-hidden": "true"});

    constructor(options: Omit<RowsOptions<R>, "series">) {
        super({...options, series: [], phases: []});
        this.extent = extentOf(this.rows.map(({trace}) => trace.fullRange()));
        const [low, high] = this.extent.map((v) => quantity(v, this.rows[0].trace.unit, true));
        this.legend.append(h("span", {class: "legend-item", "data-series": "scale"}, low, this.scaleBar, high));
    }

    protected verticalTicks(): Ticks {
        const n = this.rows.length, labels = new Map<number, string>(), step = Math.ceil(n / (this.height / 11));
        this.rows.forEach(({label}, k) => { if (k % step === step >> 1) labels.set(n - k - 0.5, label); });
        return {values: [...labels.keys()], text: (v) => labels.get(v) || ""};
    }

    protected paint(pen: Pen, area: Area) {
        const ratio = devicePixelRatio || 1, columns = Math.max(1, Math.round(area.w * ratio)), {a, b} = this.view, n = this.rows.length;
        const image = new ImageData(columns, n), pixels = new Uint32Array(image.data.buffer), shades = this.shades();
        this.rows.forEach(({trace}, row) => {
            for (let c = 0; c < columns; ++c) {
                const [low, high] = trace.rangeBetween(a + (b - a) * c / columns, a + (b - a) * (c + 1) / columns);
                if (low !== null && high !== null) pixels[row * columns + c] = shades(Math.abs(low) > Math.abs(high) ? low : high);
            }
        });
        const canvas = h("canvas", {width: columns, height: n});
        canvas.getContext("2d")!.putImageData(image, 0, 0);
        pen.imageSmoothingEnabled = false;
        pen.drawImage(canvas, 0, 0, columns, n, area.x, area.y, area.w, area.h);
        super.paint(pen, area);
        this.drawn = columns;
        this.paintCurrent(pen, area);
        this.paintScale(shades);
    }

    /// Marks the chosen row at the left axis.
    protected paintMargins(pen: Pen, {x, y, h: height}: Area) {
        pen.fillStyle = resolved("var(--ink)");
        const row = height / this.rows.length;
        this.rows.forEach(({isChosen}, k) => isChosen && pen.fillRect(x - 3, y + k * row, 3, Math.max(2, row)));
    }

    /// A function that gives the colour of a value as a pixel: positive and negative values have two hues.
    private shades(): (value: number) => number {
        const [low, high] = this.extent, base = low >= 0 ? low : Math.min(0, high), most = Math.max(high - base, base - low) || 1;
        const paper = components("var(--band)"), above = components("var(--series-0)"), below = components("var(--series-1)");
        return (value) => {
            const hue = value >= base ? above : below, part = Math.min(1, Math.abs(value - base) / most) ** 0.8;
            const [r, g, b] = paper.map((v, k) => Math.round(v + (hue[k] - v) * part));
            return (255 << 24) | (b << 16) | (g << 8) | r;
        };
    }

    private paintScale(shades: (value: number) => number) {
        const {width} = this.scaleBar, image = new ImageData(width, 1), pixels = new Uint32Array(image.data.buffer), [low, high] = this.extent;
        pixels.forEach((_, k) => { pixels[k] = shades(low + (high - low) * k / (width - 1)); });
        this.scaleBar.getContext("2d")!.putImageData(image, 0, 0);
    }

    protected tipOf({label, trace}: R, x: number, y: number) {
        const t = this.valueAt(x);
        return {x, y, text: `${label}: ${rangeText(trace.at(t), trace.unit)} at ${fixedText(t, (this.view.b - this.view.a) / 1000)}`};
    }

    csv() { return tracesCsv(this.rows.map(({trace}) => trace), this.rows.map(({label}) => label), this.view.a, this.view.b); }
}
