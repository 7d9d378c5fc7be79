// A quantity over two axes: a cell for each pair of their values, its colour from a scale that is drawn at the right.

import {inkOn, resolved} from "../base/colours";
import {Child} from "../base/dom";
import {label, writeLabel} from "../base/label";
import {Ticks, plainNumber, roundTicks} from "../base/text";
import {Area, Panel, PanelOptions, csvText} from "../plot/panel";
import type {Pen} from "../plot/pen";
import {connectKeys} from "../plot/pointer";
import {View} from "../plot/view";
import {Axis, axisPower, textOn, titleOf} from "./axis";

export interface HeatOptions extends Omit<PanelOptions, "series" | "title" | "isBottom"> {
    title: string;
    note?: Child;
    xAxis: Axis;
    yAxis: Axis;
    quantity: Axis;
    xs: number[];
    ys: number[];
    values: (number | null)[][];  ///< [index in xs][index in ys]; null: no value
}

/// Larger values are brighter, as in viridis, which common kinds of colour vision and printers in grey keep in order.
const STOPS = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];

export function heatComponents(fraction: number): number[] {
    const at = Math.min(Math.max(fraction, 0), 1) * (STOPS.length - 1), k = Math.min(Math.floor(at), STOPS.length - 2);
    return STOPS[k].map((c, n) => Math.round(c + (at - k) * (STOPS[k + 1][n] - c)));
}

const SCALE = {gap: 14, width: 12};

/// Column i reaches from i to i + 1.
export class HeatMap extends Panel {
    private readonly data: HeatOptions;
    private extent: [number, number];

    constructor(options: HeatOptions) {
        super({...options, title: [...label(options.title), " ", options.note], series: [], isBottom: true});
        this.data = options;
        const known = options.values.flat().filter((v): v is number => v !== null && Number.isFinite(v));
        this.extent = known.length ? [Math.min(...known), Math.max(...known)] : [0, 1];
        this.titleSpace = {top: 17, bottom: 16};
        this.rightMargin = SCALE.gap + SCALE.width + 52;
        const view = new View("");
        view.setLimits({begin: 0, end: options.xs.length, smallest: 1});
        view.add(this);
        connectKeys(view, this.plot);
    }

    protected range(): [number, number] { return [0, this.data.ys.length]; }
    protected verticalTicks(_low: number, _high: number, pixels: number) { return cellTicks(this.data.yAxis, this.data.ys, 0, this.data.ys.length, pixels / 18); }
    protected horizontalTicks(a: number, b: number, pixels: number) { return cellTicks(this.data.xAxis, this.data.xs, a, b, pixels / 70); }
    protected horizontalText(text: string) { return text; }
    protected spanText() { return `${textOn(this.data.quantity, this.extent[0])} to ${textOn(this.data.quantity, this.extent[1])}`; }

    private fractionOf(value: number) { return this.extent[1] > this.extent[0] ? (value - this.extent[0]) / (this.extent[1] - this.extent[0]) : 0.5; }

    protected paint(pen: Pen, area: Area) {
        const {xs, ys, values} = this.data, w = area.w / (this.view.b - this.view.a), height = area.h / ys.length;
        this.drawn = 0;
        pen.textAlign = "center";
        pen.textBaseline = "middle";
        values.forEach((column, i) => column.forEach((value, j) => {
            if (value === null || !Number.isFinite(value)) return;
            const [left, top] = [Math.floor(this.x(i)), Math.floor(this.y(j + 1))], shade = heatComponents(this.fractionOf(value));
            pen.fillStyle = `rgb(${shade.join(", ")})`;
            pen.fillRect(left, top, Math.floor(this.x(i + 1)) - left, Math.floor(this.y(j)) - top);
            ++this.drawn;
            const text = textOn(this.data.quantity, value);
            if (height < 17 || xs.length * ys.length > 400 || pen.measureText(text).width + 6 > w) return;
            pen.fillStyle = inkOn(shade);
            pen.fillText(text, (this.x(i) + this.x(i + 1)) / 2, (top + this.y(j)) / 2);
        }));
        pen.textBaseline = "alphabetic";
    }

    protected paintMargins(pen: Pen, area: Area) {
        const {xAxis, yAxis, quantity} = this.data, x = area.x + area.w + SCALE.gap, [low, high] = this.extent, power = axisPower(quantity, low, high);
        for (let k = 0; k < area.h; ++k) {
            pen.fillStyle = `rgb(${heatComponents(1 - k / area.h).join(", ")})`;
            pen.fillRect(x, area.y + k, SCALE.width, 1);
        }
        pen.fillStyle = resolved("var(--faint)");
        pen.textAlign = "left";
        pen.textBaseline = "middle";
        const ticks = high > low ? roundTicks(low / 10 ** power, high / 10 ** power, area.h / 40) : {values: [low / 10 ** power], text: String};
        for (const v of ticks.values) pen.fillText(ticks.text(v), x + SCALE.width + 4, high > low ? area.y + (1 - this.fractionOf(v * 10 ** power)) * area.h : area.y + area.h / 2);
        pen.textBaseline = "alphabetic";
        writeLabel(pen, titleOf(quantity, power), this.plot.clientWidth - 2, area.y - 7, "right");
        writeLabel(pen, yAxis.name, 2, area.y - 7);
        writeLabel(pen, xAxis.name, area.x + area.w / 2, area.y + area.h + 33, "center");
    }

    private cellAt(px: number, py: number): [number, number] {
        return [Math.floor(this.valueAt(px)), Math.floor(this.data.ys.length * (1 - (py - this.area.y) / this.area.h))];
    }

    protected tipAt(px: number, py: number) {
        const {xAxis, yAxis, quantity, xs, ys, values} = this.data, [i, j] = this.cellAt(px, py);
        if (values[i]?.[j] === undefined) return null;
        return {x: px, y: py, text: `${xAxis.name} ${textOn(xAxis, xs[i])}, ${yAxis.name} ${textOn(yAxis, ys[j])}: ${textOn(quantity, values[i][j])}`};
    }

    showCursor() { super.showCursor(null); }

    csv() {
        const {xAxis, yAxis, quantity, xs, ys, values} = this.data, cell = (axis: Axis, v: number) => (axis.words ? axis.words[v] : plainNumber(v));
        return csvText([titleOf(xAxis, 0), titleOf(yAxis, 0), titleOf(quantity, 0)], xs.flatMap((x, i) => ys.map((y, j) => [cell(xAxis, x), cell(yAxis, y), values[i][j] === null ? null : plainNumber(values[i][j]!)])));
    }
}

/// Ticks in the middle of cells; every second or third value if there is no space for all.
function cellTicks(axis: Axis, values: number[], a: number, b: number, count: number): Ticks {
    const step = Math.max(1, Math.ceil((b - a) / count)), shown = values.map((_, k) => k).filter((k) => k % step === 0 && k + 0.5 >= a && k + 0.5 <= b);
    return {values: shown.map((k) => k + 0.5), text: (v) => textOn(axis, values[Math.floor(v)])};
}
