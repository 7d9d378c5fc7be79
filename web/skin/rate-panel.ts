// Firing rates of the classes of a skin, each the mean over those of its afferents that fire. Afferents far from the touch would lower it.

import {resolved} from "../base/colours";
import {quantity} from "../base/text";
import {Area, PanelOptions, csvText} from "../plot/panel";
import type {Pen} from "../plot/pen";
import {TimePanel, withMargins} from "../panels/time-panel";
import type {SkinRecording} from "./recording";

const BINS = 120;  // in the visible range, about

export class SkinRatePanel extends TimePanel {
    private skin: SkinRecording;
    private rates: Float64Array[] = [];  // Hz, of each class
    private bin = 0;                     // s
    private title: Text = document.createTextNode("");

    constructor(options: Omit<PanelOptions, "series" | "title"> & {skin: SkinRecording}) {
        const {skin} = options;
        super({...options, title: [], clock: skin.clock, phases: skin.phases, series: skin.classes.map(({name, colour}) => ({name, colour, width: 2}))});
        this.skin = skin;
        this.addTitle(this.title);
    }

    /// Merges the narrow bins of the data, so that the visible range has about BINS bins.
    private renew() {
        const {perClass, classes, duration} = this.skin, span = this.view.b - this.view.a;
        const join = 2 ** Math.max(0, Math.round(Math.log2(span / BINS / perClass.width))), bin = join * perClass.width;
        if (bin === this.bin) return;
        this.bin = bin;
        this.rates = classes.map(() => new Float64Array(Math.ceil(perClass.count / join)));
        for (let f = 0; f < perClass.count; ++f) perClass.each(f, (c, n) => { this.rates[c][Math.floor(f / join)] += n; });
        this.rates.forEach((values, c) => values.forEach((n, k) => { values[k] = n / Math.max(1, classes[c].active) / (Math.min(bin, duration - k * bin) || bin); }));
        this.title.data = `mean rate of the afferents that fire, in bins of ${quantity(bin, "s", true)} (Hz)`;
    }

    private binAt(t: number) { return Math.floor((t - this.clock.t0) / this.bin + 1e-9); }

    protected range(isAutoscale: boolean): [number, number] {
        this.renew();
        const [from, to] = isAutoscale ? [Math.max(0, this.binAt(this.view.a)), this.binAt(this.view.b) + 1] : [0, Infinity];
        const most = this.rates.reduce((high, values, c) => (this.isVisible(this.series[c]) ? values.subarray(from, to).reduce((m, v) => Math.max(m, v), high) : high), 0);
        return [0, withMargins([0, most || 1])[1]];
    }

    protected paint(pen: Pen, area: Area) {
        super.paint(pen, area);
        const from = Math.max(0, this.binAt(this.view.a)), to = Math.min(this.rates[0].length, this.binAt(this.view.b) + 1);
        this.series.forEach((one, c) => {
            if (!this.isVisible(one)) return;
            pen.strokeStyle = resolved(one.colour);
            pen.lineWidth = one.width!;
            pen.beginPath();
            for (let k = from; k < to; ++k) {
                const left = this.x(this.clock.t0 + k * this.bin), right = this.x(this.clock.t0 + (k + 1) * this.bin), y = this.y(this.rates[c][k]);
                pen[k === from ? "moveTo" : "lineTo"](left, y);
                pen.lineTo(right, y);
            }
            pen.stroke();
        });
    }

    protected showValues(t: number) { this.series.forEach(({name}, c) => this.setValue(name, quantity(this.rates.length ? this.rates[c][this.binAt(t)] : null, "Hz"))); }

    csv() {
        const from = Math.max(0, this.binAt(this.view.a)), to = Math.min(this.rates[0].length, this.binAt(this.view.b) + 1);
        const rows = Array.from({length: to - from}, (_, k) => [this.clock.t0 + (from + k) * this.bin, ...this.rates.map((values) => values[from + k])]);
        return csvText(["time_s", ...this.series.map(({name}) => `${name}_Hz`)], rows);
    }
}
