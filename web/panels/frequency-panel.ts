// The instantaneous frequency of spike trains: f_k = 1 / (t[k+1] - t[k]) as a mark at the time t[k] of its spike. The last spike has none.

import {resolved} from "../base/colours";
import {h} from "../base/dom";
import {PREFIXES, fixedText, prefixPower, quantity, roundTicks} from "../base/text";
import {Area, csvText} from "../plot/panel";
import type {Pen} from "../plot/pen";
import type {Spikes} from "./signals";
import {TimePanel, TimePanelOptions, fromZero} from "./time-panel";

/// `shape`: selects the shape of the marks, so that trains differ in shape as well as in colour.
export interface FrequencyTrain { name: string; colour: string; shape: number; spikes: Spikes }
export interface FrequencyOptions extends Omit<TimePanelOptions, "series"> { trains: FrequencyTrain[] }

const MARKS = ["●", "▲", "■", "◆"];
/// Corners of the marks, in units of their size; none for a disc.
const CORNERS = [[], [[0, -1.2], [1.1, 0.8], [-1.1, 0.8]], [[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]], [[0, -1.3], [1.3, 0], [0, 1.3], [-1.3, 0]]];
const SIZE = 2.5;  // pixels

export class FrequencyPanel extends TimePanel {
    private trains: FrequencyTrain[];
    private power: number;  // of ten, of the prefix of the axis

    constructor({trains, ...rest}: FrequencyOptions) {
        super({...rest, series: trains.map(({name, colour, shape}) => ({name, colour, mark: MARKS[shape % 4]}))});
        this.trains = trains;
        this.power = prefixPower(this.highest(-Infinity, Infinity), "Hz");
        this.addTitle(" ", h("span", {class: "unit"}, `(${PREFIXES[this.power]}Hz)`));
    }

    private get shown() { return this.trains.filter((_, k) => this.isVisible(this.series[k])); }

    /// The largest frequency between two times.
    private highest(a: number, b: number) { return this.trains.reduce((high, {spikes}) => Math.max(high, spikes.frequency.range(spikes.before(a), spikes.before(b))[1] || 0), 0); }

    protected range(isAutoscale: boolean) { return fromZero(isAutoscale ? this.highest(this.view.a, this.view.b) : this.highest(-Infinity, Infinity)); }

    protected verticalTicks(low: number, high: number, pixels: number) {
        const scale = 10 ** this.power, ticks = roundTicks(low / scale, high / scale, pixels / 24);
        return {values: ticks.values.map((v) => v * scale), text: (v: number) => ticks.text(v / scale)};
    }

    protected paint(pen: Pen, area: Area) {
        super.paint(pen, area);
        this.drawn = 0;
        for (const train of this.shown) {
            pen.fillStyle = resolved(train.colour);
            const points = this.points(this.trains.indexOf(train));
            for (let k = 0; k < points.length; k += 2) this.paintMark(pen, train.shape % 4, this.x(points[k]), this.y(points[k + 1]));
            this.drawn += points.length / 2;
        }
    }

    private paintMark(pen: Pen, shape: number, x: number, y: number) {
        pen.beginPath();
        if (shape === 0) pen.arc(x, y, SIZE, 0, 2 * Math.PI);
        else CORNERS[shape].forEach(([dx, dy], k) => (k ? pen.lineTo(x + dx * SIZE, y + dy * SIZE) : pen.moveTo(x + dx * SIZE, y + dy * SIZE)));
        pen.fill();
    }

    /// The visible marks t, f, t, f ... of train k: all if there are few, else the smallest and the largest frequency of each column of a pixel.
    points(k: number): number[] {
        const {spikes} = this.trains[k], {a, b} = this.view, width = Math.ceil(this.area.w), margin = 2 * SIZE * (b - a) / this.area.w;
        const first = spikes.before(a - margin), last = Math.min(spikes.before(b + margin), spikes.count - 1), out: number[] = [];
        const add = (t: number, i: number, j: number) => {
            const [low, high] = spikes.frequency.range(i, j);
            if (low !== null) out.push(t, low, ...(high === low ? [] : [t, high]));
        };
        if (last - first <= 2 * width) for (let i = first; i < last; ++i) add(spikes.times[i], i, i + 1);
        else
            for (let c = 0, from = spikes.before(a); c < width; ++c) {
                const to = spikes.before(a + (b - a) * (c + 1) / width);
                add(a + (b - a) * (c + 0.5) / width, from, to);
                from = to;
            }
        return out;
    }

    /// Shows the frequency at the last spike before t.
    protected showValues(t: number) {
        this.trains.forEach(({name, spikes}) => {
            const k = spikes.before(t) - 1;
            this.setValue(name, k < 0 || k >= spikes.count - 1 ? "–" : quantity(spikes.frequency.range(k, k + 1)[0], "Hz"));
        });
    }

    /// The mark nearest to the pointer, within 6 pixels.
    protected tipAt(x: number, y: number) {
        const near = this.shown.map(({name, spikes}) => {
            const k = Math.min(spikes.nearest(this.valueAt(x)), spikes.count - 2), f = k >= 0 ? spikes.frequency.range(k, k + 1)[0] : null;
            return f === null ? null : {x: this.x(spikes.times[k]), y: this.y(f), text: `${name}: ${quantity(f, "Hz")} at ${fixedText(spikes.times[k], 1e-6)}`};
        }).filter((one): one is {x: number; y: number; text: string} => one !== null && Math.hypot(one.x - x, one.y - y) < 6);
        return near.length ? near.reduce((best, one) => (Math.hypot(one.x - x, one.y - y) < Math.hypot(best.x - x, best.y - y) ? one : best)) : null;
    }

    csv() {
        const {a, b} = this.view;
        return csvText(["afferent", "time_s", "frequency_Hz"], this.shown.flatMap(({name, spikes}) => {
            const first = spikes.before(a), last = Math.min(spikes.before(b), spikes.count - 1);
            return Array.from({length: Math.max(0, last - first)}, (_, k) => [name, spikes.times[first + k], spikes.frequency.range(first + k, first + k + 1)[0]]);
        }));
    }
}
