// One quantity of several implementations of an afferent type. The left axis is that of the reference. Implementations with another scale are read on
// the right axis, which has the scale of the first of them.

import {mixed, resolved} from "../base/colours";
import {h, isNarrow} from "../base/dom";
import {PREFIXES, prefixPower, roundTicks, unitText} from "../base/text";
import type {Area} from "../plot/panel";
import type {Pen} from "../plot/pen";
import type {Range} from "../base/pyramid";
import {Trace} from "./signals";
import {TracePanel, TracePanelOptions} from "./trace-panel";

/// Maps values of an implementation to the axis of the reference: offset + factor * value.
export class Scale {
    constructor(readonly offset = 0, readonly factor = 1) {}
    to(value: number) { return this.offset + this.factor * value; }
    from(axisValue: number) { return (axisValue - this.offset) / this.factor; }
    get isIdentity() { return this.offset === 0 && this.factor === 1; }
}

/// A trace whose ranges are scaled to the axis of the reference; at() returns unscaled values, for the legend.
class ScaledTrace extends Trace {
    constructor(readonly source: Trace, private scale: Scale) { super(source["record"], source.clock); }
    at(t: number) { return this.source.at(t); }
    range(k: number, l: number): Range {
        const [low, high] = this.source.range(k, l);
        if (low === null || high === null) return [null, null];
        return this.scale.factor < 0 ? [this.scale.to(high), this.scale.to(low)] : [this.scale.to(low), this.scale.to(high)];
    }
}

/// The colour of a series, with enough contrast for texts.
const textColour = (colour: string) => mixed(colour, "var(--ink)", 0.45);

export interface Implementation { trace: Trace; scale: Scale; colour: string; name: string }
export interface OverlayOptions extends Omit<TracePanelOptions, "traces" | "series"> { implementations: Implementation[] }

export class OverlayPanel extends TracePanel {
    readonly right: Implementation | null;
    private rightScale = 1;  // the value that the right axis labels 1

    constructor({implementations, ...rest}: OverlayOptions) {
        super({...rest, traces: implementations.map(({trace, scale}) => (scale.isIdentity ? trace : new ScaledTrace(trace, scale))),
               series: implementations.map(({name, colour}, k) => ({name, colour, width: k ? 1.3 : 2.2}))});
        this.tickPixels = 23;
        this.right = implementations.find(({scale}) => !scale.isIdentity) || null;
        if (!this.right) return;
        const {scale, colour, name, trace} = this.right, power = prefixPower(Math.max(...this.extent.map((v) => Math.abs(scale.from(v)))), trace.unit);
        [this.rightScale, this.rightMargin] = [10 ** power, isNarrow() ? 38 : 58];
        this.heading.append(h("span", {class: "right-title", style: `color: ${textColour(colour)}`}, `${name}${scale.factor < 0 ? ", inverted" : ""} (${PREFIXES[power]}${unitText(trace.unit)})`));
    }

    /// Round values of the right axis: [value in SI, text].
    rightTicks(): [number, string][] {
        if (!this.right) return [];
        const ends = [this.low, this.high].map((v) => this.right!.scale.from(v) / this.rightScale);
        const {values, text} = roundTicks(Math.min(...ends), Math.max(...ends), this.area.h / this.tickPixels);
        return values.map((v) => [v * this.rightScale, text(v)]);
    }

    protected paintMargins(pen: Pen, {x, y, w, h: height}: Area) {
        if (!this.right) return;
        pen.fillStyle = resolved(textColour(this.right.colour));
        pen.textAlign = "left";
        pen.textBaseline = "middle";
        for (const [value, text] of this.rightTicks()) {
            const at = this.y(this.right.scale.to(value));
            pen.fillRect(x + w, Math.round(at), 4, 1);
            pen.fillText(text, x + w + 7, Math.min(Math.max(at, y + 5), y + height - 3));
        }
        pen.textBaseline = "alphabetic";
    }
}
