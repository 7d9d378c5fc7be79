// A plot of curves, points, rasters or histograms over any quantity.

import {resolved} from "../base/colours";
import {h} from "../base/dom";
import {label, writeLabel} from "../base/label";
import {Ticks} from "../base/text";
import {Area, Panel, PanelOptions, Series} from "../plot/panel";
import type {Pen} from "../plot/pen";
import {connectKeys} from "../plot/pointer";
import {View} from "../plot/view";
import {Axis, axisPower, positionOn, spanOn, textOn, ticksOf, titleOf, valueOn} from "./axis";
import {binAt, curvesCsv, nameOf, nearestIndex, placedCurves} from "./curve-values";
import {Curve, Plane, extentsOf, paintCurve} from "./curves";
import {withMargins} from "./time-panel";

/// A dashed line across the plot, such as a limit.
export interface Level { value: number; isVertical?: boolean }

export interface XyOptions extends Omit<PanelOptions, "series" | "title" | "isBottom"> {
    title: string;
    note?: string;                ///< after the title
    xAxis: Axis;
    yAxis: Axis;
    curves: Curve[];
    levels?: Level[];
    range?: [number, number];     ///< of the vertical axis, if it is not that of the curves
}

export class XyPanel extends Panel {
    readonly curves: Curve[];
    protected readonly xAxis: Axis;
    protected readonly yAxis: Axis;
    private placed: Curve[];      // with positions instead of values
    private levels: Level[];
    private given?: [number, number];
    private isRaster: boolean;

    constructor(options: XyOptions) {
        const {curves, title, note, xAxis, yAxis, levels = [], range} = options;
        super({...options, title: [...label(title), note ? h("small", {}, " ", note) : null], series: curves.filter(({name}) => name !== ""), isBottom: true});
        [this.curves, this.xAxis, this.yAxis, this.levels, this.given] = [curves, xAxis, yAxis, levels, range];
        this.isRaster = curves.length > 0 && curves.every(({style}) => style === "raster");
        this.placed = placedCurves(curves, xAxis, yAxis, this.isRaster);
        this.titleSpace = {top: this.yAxis.name && !this.isRaster ? 17 : 0, bottom: xAxis.name ? 16 : 0};
        this.startView();
    }

    private startView() {
        const [[low, high]] = extentsOf(this.placed.filter(({isReference}) => !isReference));
        const hasMargin = this.curves.some(({style, hasPoints}) => hasPoints || (style !== "line" && style !== "steps")), margin = (hasMargin ? 0.03 : 0) * (high - low) || (high > low ? 0 : Math.abs(low) / 10 || 1);
        const view = new View(""), length = high - low + 2 * margin;
        view.setLimits({begin: low - margin, end: high + margin, smallest: length / 1e5});
        view.add(this);
        connectKeys(view, this.plot);
    }

    private get shownCurves() { return this.placed.filter((curve) => this.isVisible(curve)); }

    protected isVisible(one: Series) { return !this.hidden.has(nameOf(this.placed, one as Curve)); }

    protected range(): [number, number] {
        if (this.isRaster) return [0, this.curves.length];
        if (this.given) return this.given;
        const {view} = this, curves = this.shownCurves.filter(({isReference}) => !isReference);
        let [low, high] = (view.isComplete ? extentsOf(curves) : extentsOf(curves, view.a, view.b))[1];
        for (const {value, isVertical} of this.levels) {  // a limit that is far away would flatten the curves
            const at = positionOn(this.yAxis, value), span = high - low;
            if (!isVertical && at > low - span && at < high + span) [low, high] = [Math.min(low, at), Math.max(high, at)];
        }
        const [from, to] = withMargins([low, high]);
        return curves.some(({style}) => style === "steps") ? [0, to] : [from, to];
    }

    protected verticalTicks(low: number, high: number, pixels: number): Ticks {
        if (!this.isRaster) return ticksOf(this.yAxis, low, high, pixels / 32);
        const names = new Map(this.curves.map(({name}, k) => [this.curves.length - k - 0.5, name]));
        return {values: this.curves.every(({name}) => name.length <= 20) ? [...names.keys()] : [], text: (v) => names.get(v)!};
    }

    protected horizontalTicks(a: number, b: number, pixels: number): Ticks { return ticksOf(this.xAxis, a, b, pixels / 80); }
    protected horizontalText(text: string) { return text; }
    protected spanText() { return spanOn(this.xAxis, this.view.a, this.view.b); }

    protected paint(pen: Pen, area: Area) {
        const plane: Plane = {x: (v) => this.x(v), y: (v) => this.y(v)};
        const curves = this.shownCurves, rowHeight = area.h / Math.max(1, this.curves.length);
        for (const curve of curves) paintCurve(pen, curve, plane, rowHeight);
        this.levels.forEach((level) => this.paintLevel(pen, area, level));
        this.drawn = curves.reduce((sum, {x}) => sum + x.length, 0);
    }

    private paintLevel(pen: Pen, area: Area, {value, isVertical}: Level) {
        pen.strokeStyle = resolved("var(--ink)");
        pen.lineWidth = 1;
        pen.setLineDash([5, 3]);
        pen.beginPath();
        if (isVertical) {
            const x = this.x(positionOn(this.xAxis, value));
            pen.moveTo(x, area.y);
            pen.lineTo(x, area.y + area.h);
        } else {
            const y = this.y(positionOn(this.yAxis, value));
            pen.moveTo(area.x, y);
            pen.lineTo(area.x + area.w, y);
        }
        pen.stroke();
        pen.setLineDash([]);
    }

    /// The titles of the axes: that of y above its upper end, that of x below its middle.
    protected paintMargins(pen: Pen, area: Area) {
        pen.fillStyle = resolved("var(--faint)");
        pen.textBaseline = "alphabetic";
        if (this.titleSpace.top) writeLabel(pen, titleOf(this.yAxis, axisPower(this.yAxis, this.low, this.high)), 2, area.y - 7);
        if (this.titleSpace.bottom) writeLabel(pen, titleOf(this.xAxis, axisPower(this.xAxis, this.view.a, this.view.b)), area.x + area.w / 2, area.y + area.h + 33, "center");
    }

    protected showValues(at: number) {
        for (const [k, {name, style, x, y}] of this.placed.entries()) {
            if (!name || (style !== "line" && style !== "steps") || !this.isVisible(this.placed[k])) continue;
            const i = style === "steps" ? binAt(x, at) : nearestIndex(x, at);
            this.setValue(name, i >= 0 && i < y.length ? textOn(this.yAxis, this.curves[k].y[i]) : "");
        }
    }

    /// The nearest point of a visible curve within 14 pixels.
    protected tipAt(px: number, py: number) {
        let best: {curve: Curve; k: number} | null = null, distance = 14;
        for (const curve of this.shownCurves) {
            if (curve.style === "steps") continue;
            for (let k = 0; k < curve.x.length; ++k) {
                const d = Math.hypot(this.x(curve.x[k]) - px, this.y(curve.y[k]) - py);
                if (d < distance) [best, distance] = [{curve, k}, d];
            }
        }
        if (!best) return null;
        const {curve, k} = best, own = this.curves[this.placed.indexOf(curve)], name = nameOf(this.placed, curve);
        const at = `${this.xAxis.name} ${textOn(this.xAxis, own.x[k])}`, text = this.isRaster ? at : `${at}, ${this.yAxis.name || "y"} ${textOn(this.yAxis, own.y[k])}`;
        return {x: this.x(curve.x[k]), y: this.y(curve.y[k]), text: name ? `${name}: ${text}` : text};
    }

    csv() { return curvesCsv(this.curves, this.placed, this.xAxis, this.yAxis, this.view.a, this.view.b); }

    /// The value of x at a pixel, on a logarithmic axis too.
    xAt(pixel: number) { return valueOn(this.xAxis, this.valueAt(pixel)); }
}
