// Firing rates in bins as steps: the mean over copies or over the afferents of a class, or a histogram over trials (PSTH) with its standard error.

import {resolved} from "../base/colours";
import {firstAt} from "../base/arrays";
import {h} from "../base/dom";
import {PREFIXES, prefixPower, quantity, roundTicks} from "../base/text";
import {Area, Series, csvText} from "../plot/panel";
import type {Pen} from "../plot/pen";
import {TimePanel, TimePanelOptions, fromZero} from "./time-panel";

/// Bin k is from edges[k] to edges[k + 1] (s). A rate that is null or NaN is unknown, Hz. `errors`: standard errors, Hz.
export interface RateCurve extends Series { edges: ArrayLike<number>; values: ArrayLike<number | null>; errors?: ArrayLike<number | null> }
export interface RateOptions extends Omit<TimePanelOptions, "series"> { curves: RateCurve[] }

const DASHES = [undefined, [6, 3], [2, 2], [8, 2, 2, 2]];
export const dashOf = (index: number) => DASHES[index % DASHES.length];

/// The edges of `count` equal bins (s). The last one ends at `end`.
export const equalBins = (begin: number, bin: number, count: number, end = Infinity) => Array.from({length: count + 1}, (_, k) => Math.min(begin + k * bin, k === count ? end : Infinity));

export class RatePanel extends TimePanel {
    private curves: RateCurve[];
    private power: number;  // of ten, of the prefix of the axis

    constructor({curves, ...rest}: RateOptions) {
        super({...rest, series: curves});
        this.curves = curves;
        this.power = prefixPower(this.highest(-Infinity, Infinity), "Hz");
        this.addTitle(" ", h("span", {class: "unit"}, `(${PREFIXES[this.power]}Hz)`));
    }

    /// Replaces the curves, which must have the same series.
    setCurves(curves: RateCurve[]) {
        this.curves = curves;
        this.view.request();
    }

    private get shown() { return this.curves.filter((one) => this.isVisible(one)); }

    /// The bins of a curve that the times from a to b touch.
    private bins({edges, values}: RateCurve, a: number, b: number): [number, number] {
        return [Math.max(0, firstAt(edges, a) - 1), Math.min(values.length, firstAt(edges, b))];
    }

    /// The largest rate, with its standard error, between two times.
    private highest(a: number, b: number) {
        let high = 0;
        for (const curve of this.curves)
            for (let [k, last] = this.bins(curve, a, b); k < last; ++k) high = Math.max(high, (curve.values[k] || 0) + (curve.errors && curve.errors[k] || 0));
        return high;
    }

    protected range(isAutoscale: boolean) { return fromZero(isAutoscale ? this.highest(this.view.a, this.view.b) : this.highest(-Infinity, Infinity)); }

    protected verticalTicks(low: number, high: number, pixels: number) {
        const scale = 10 ** this.power, ticks = roundTicks(low / scale, high / scale, pixels / 28);
        return {values: ticks.values.map((v) => v * scale), text: (v: number) => ticks.text(v / scale)};
    }

    protected paint(pen: Pen, area: Area) {
        super.paint(pen, area);
        this.drawn = 0;
        for (const curve of this.shown) this.paintErrors(pen, curve);
        for (const curve of this.shown) this.paintSteps(pen, curve);
    }

    private paintErrors(pen: Pen, curve: RateCurve) {
        if (!curve.errors) return;
        pen.save();
        pen.fillStyle = resolved(curve.colour);
        pen.globalAlpha = 0.18;
        for (let [k, last] = this.bins(curve, this.view.a, this.view.b); k < last; ++k) {
            const value = curve.values[k], error = curve.errors[k], x = this.x(curve.edges[k]);
            if (isKnown(value) && error) pen.fillRect(x, this.y(value + error), this.x(curve.edges[k + 1]) - x, this.y(value - error) - this.y(value + error));
        }
        pen.restore();
    }

    private paintSteps(pen: Pen, curve: RateCurve) {
        pen.strokeStyle = resolved(curve.colour);
        pen.lineWidth = curve.width || 1.6;
        pen.setLineDash(curve.dash || []);
        pen.beginPath();
        let isDown = false;
        for (let [k, last] = this.bins(curve, this.view.a, this.view.b); k < last; ++k) {
            const value = curve.values[k], x = this.x(curve.edges[k]);
            if (isKnown(value)) {
                if (isDown) pen.lineTo(x, this.y(value)); else pen.moveTo(x, this.y(value));
                pen.lineTo(this.x(curve.edges[k + 1]), this.y(value));
                this.drawn += 2;
            }
            isDown = isKnown(value);
        }
        pen.stroke();
        pen.setLineDash([]);
    }

    protected showValues(t: number) { for (const curve of this.curves) this.setValue(curve.name, this.textAt(curve, t)); }

    private textAt({edges, values, errors}: RateCurve, t: number): string {
        let k = firstAt(edges, t);
        if (edges[k] !== t) --k;
        const value = values[k], error = errors && errors[k];
        return isKnown(value) ? rateText(value) + (isKnown(error) ? ` ± ${rateText(error)}` : "") : "–";
    }

    csv() {
        return csvText(["series", "from_s", "to_s", "rate_Hz", "standard_error_Hz"], this.shown.flatMap((curve) => {
            const [first, last] = this.bins(curve, this.view.a, this.view.b);
            return Array.from({length: last - first}, (_, k) => [curve.name, curve.edges[first + k], curve.edges[first + k + 1], curve.values[first + k], curve.errors ? curve.errors[first + k] : null]);
        }));
    }
}

const isKnown = (value: number | null | undefined): value is number => value !== null && value !== undefined && !Number.isNaN(value);
const rateText = (rate: number) => (rate < 1 ? `${Number(rate.toPrecision(3))}\u00a0Hz` : quantity(rate, "Hz"));
