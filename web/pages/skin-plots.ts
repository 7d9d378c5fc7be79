// The plots over time of the page of a skin: total force, mean rates of the classes, rasters.

import {chooser, h} from "../base/dom";
import {quantity} from "../base/text";
import {RatePanel, equalBins} from "../panels/rate-panel";
import {Trace} from "../panels/signals";
import {TracePanel} from "../panels/trace-panel";
import type {View} from "../plot/view";
import type {Panel} from "../plot/panel";
import {hint, section, timeToolbar} from "../shell";
import {CountRasterPanel, SkinRasterPanel} from "../skin/raster-panels";
import type {RecordedClass, SkinRecording} from "../skin/recording";

export class SkinPlots {
    private rasters = h("div");
    private shown: Panel[] = [];
    private region: number | null = null;  // of the rasters; null: all regions
    private select: HTMLSelectElement | null = null;

    constructor(host: Element, private skin: SkinRecording, private view: View, private pick: (mark: number | null) => void, private changed: () => void) {
        const {over, regions} = skin.data, {clock, phases} = skin, {description, contact} = skin.data.summary.input;
        const node = section(host, "plots", "Force, rates and spikes", [description, contact].filter((text, k, all) => text && all.indexOf(text) === k).join("; "));
        const trace = new Trace(over.force, {...clock, samples: over.samples});
        const bar = timeToolbar(node, view);
        document.querySelector(".player")!.append(bar.querySelector("#now")!);
        node.append(hint());
        view.add(new TracePanel({host: node, name: "force", title: ["total force"], about: "total force", height: 100, clock, phases, isNamed: true, traces: [trace], series: [{name: "force", label: [], colour: "var(--ink)", width: 1.6}]}),
                 this.ratePanel(node));
        const choice = h("div", {class: "bar"});
        if (regions.length > 1) {
            const label = chooser("Rasters of", ["all regions", ...regions], 0, (k) => this.setRegion(regions[k - 1] || ""));
            this.select = label.querySelector("select")!;
            this.select.id = "raster-region";
            choice.append(label);
        }
        if (!skin.trains) choice.append(h("span", {class: "note"}, `More than ${over.max_spikes} spikes: the rasters show counts per frame of the maps (${quantity(skin.marks.width, "s", true)}).`));
        node.append(choice, this.rasters);
        this.addRasters();
    }

    /// Mean rates of the classes in about 120 bins over the visible range. Afferents that never fire, such as those far from the touch, are left out.
    private ratePanel(host: Element) {
        const {perClass, classes, clock, phases, duration} = this.skin, text = document.createTextNode("");
        let bin = 0;
        const curves = () => {
            const count = Math.ceil(perClass.count * perClass.width / bin - 1e-9), edges = equalBins(clock.t0, bin, count, clock.t0 + duration), join = Math.round(bin / perClass.width);
            const rates = classes.map(({name, colour}) => ({name, colour, width: 2, edges, values: new Float64Array(count)}));
            for (let f = 0; f < perClass.count; ++f) perClass.each(f, (c, n) => { rates[c].values[Math.floor(f / join)] += n / Math.max(1, classes[c].active) / (edges[Math.floor(f / join) + 1] - edges[Math.floor(f / join)]); });
            text.data = `mean rate of the afferents that fire, in bins of ${quantity(bin, "s", true)}`;
            return rates;
        };
        const binOf = (span: number) => perClass.width * 2 ** Math.max(0, Math.round(Math.log2(span / 120 / perClass.width)));
        bin = binOf(duration);
        const panel = new RatePanel({host, name: "population", title: [text], about: "mean rate of the afferents that fire", height: 140, phases, curves: curves(), isBottom: true});
        this.view.onDraw(() => {
            if (bin === binOf(this.view.b - this.view.a)) return;
            bin = binOf(this.view.b - this.view.a);
            panel.setCurves(curves());
        });
        return panel;
    }

    get regionName() { return this.region === null ? null : this.skin.data.regions[this.region]; }

    /// Shows the rasters of a region; those of all regions if there is none of this name.
    setRegion(name: string | undefined) {
        const region = this.skin.data.regions.indexOf(name || "");
        if (this.select) this.select.selectedIndex = region + 1;
        if (this.region === (region < 0 ? null : region)) return;
        this.region = region < 0 ? null : region;
        this.addRasters();
        this.changed();
    }

    private addRasters() {
        this.view.panels = this.view.panels.filter((one) => !this.shown.includes(one));
        this.shown.forEach((one) => one.remove());
        const {classes, trains} = this.skin;
        this.shown = classes.map((one, k) => (trains ? this.raster(one, k === classes.length - 1) : this.counts(one, k === classes.length - 1)));
        this.view.add(...this.shown);
    }

    private isWanted(mark: number) { return this.region === null || this.skin.region[mark] === this.region; }

    private options({name, colour}: RecordedClass, isBottom: boolean, rows: number, text: string) {
        return {host: this.rasters, name: `raster ${name}`, about: `spikes of ${name}`, title: [h("span", {class: "chip", style: `background: ${colour}`}), `${name} spikes`, h("span", {class: "unit"}, ` ${text}; neighbours are adjacent`)],
                height: Math.max(36, Math.min(120, 6 * rows), Math.min(180, 40 + 0.6 * rows)), phases: this.skin.phases, isBottom, series: [{name, label: [], colour, width: 3}]};
    }

    /// The afferents of the chosen region that fired.
    private raster(one: RecordedClass, isBottom: boolean) {
        const {skin} = this, all = skin.trains!.filter(({afferent}) => afferent >= one.firstAfferent && afferent < one.firstAfferent + one.afferents);
        const own = all.filter(({afferent}) => this.isWanted(skin.markOf(afferent)));
        const rows = own.map(({afferent, spikes}) => ({series: one.name, label: skin.nameOf(afferent), colour: one.colour, spikes, mark: skin.markOf(afferent), about: `${skin.nameOf(afferent)}, ${skin.data.regions[skin.region[skin.markOf(afferent)]]}`}));
        return new SkinRasterPanel({...this.options(one, isBottom, rows.length, this.countText(rows.length, all.length, `${one.afferents} afferents`)), rows, point: this.pick});
    }

    private counts(one: RecordedClass, isBottom: boolean) {
        const {skin} = this, {first, end, afferents, name, colour} = one, perMark = skin.data.over.afferents_per_mark;
        const fired = Array.from({length: end - first}, (_, k) => first + k).filter((mark) => skin.totals[mark]), marks = fired.filter((mark) => this.isWanted(mark));
        const text = this.countText(marks.length, fired.length, perMark > 1 ? `${end - first} groups of ${perMark} afferents` : `${afferents} afferents`);
        return new CountRasterPanel({...this.options(one, isBottom, marks.length, text), frames: skin.marks, t0: skin.clock.t0, marks, colour, label: name, nameOf: (mark) => skin.markName(mark)});
    }

    private countText(rows: number, fired: number, all: string) { return this.region === null ? `${fired} of ${all} fired` : `${rows} of ${fired} that fired, in ${this.regionName}`; }
}
