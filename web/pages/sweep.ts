// The page of a sweep: figures of the selected measure, then tables. Confidence intervals and distributions are shown only if items are drawn at
// random.

import {chooser, fill, h} from "../base/dom";
import {linkValues, setLink} from "../base/link";
import {forgetRemoved} from "../base/panels";
import {plainNumber} from "../base/text";
import type {SweepData} from "../data/sweep";
import {section, showVersions, startPage} from "../shell";
import {Sweep} from "./sweep-data";
import {GridChoice, axisChoosers, showEffects, showGridFigures, showGridMeasures, showMainEffects, variedAxes} from "./sweep-grid";
import {Choice, showEnvelope, showFactor, showHistogram, showNormalPlot, showRaster} from "./sweep-random";
import {itemTable, openingText, showAxes, showDistributions, showFailed, showInfluences, showPoints, showYields} from "./sweep-tables";

export function showSweepPage(data: SweepData) {
    const main = startPage(data), sweep = new Sweep(data);
    main.append(h("p", {id: "opening"}, sweep.isGrid ? `${openingText(sweep)}; a grid of ${data.summary.axes.map(({name}) => name).join(" by ")}, without random parameters` : openingText(sweep)));
    if (!data.summary.finished) return;
    const {all} = data.summary;
    if (!sweep.isGrid || all.passed < all.items) showYields(section(main, "yields", sweep.isGrid ? "Limits" : "Yield"), sweep);
    const figures = new Figures(main, sweep);
    showAxes(main, sweep);
    const measures = section(main, "measures", "Measures", sweep.isGrid ? "" : sweep.isMixed ? "over all grid points, without confidence intervals, because the points are not random" : "with 95 % confidence intervals");
    if (sweep.isGrid) showGridMeasures(measures, sweep);
    else showDistributions(measures, sweep);
    if (sweep.isGrid) showEffects(main, sweep);
    else showInfluences(main, sweep);
    showPoints(main, sweep);
    figures.showExtremes(main);
    showFailed(main, sweep);
    if (data.versions) showVersions(main, data.versions);
    figures.draw();
}

/// The figures, which depend on the selected measure, grouping and axes. The link of the page has the selection.
class Figures {
    private choice: Choice = {measure: 0, grouping: 0};
    private grid: GridChoice;
    private axes = h("span", {class: "choosers"});
    private panels = h("div", {id: "figures"});
    private extremes: HTMLElement | null = null;

    constructor(private host: Element, private sweep: Sweep) {
        this.grid = {x: 0, y: 1, fixed: sweep.summary.axes.map(() => null)};
        if (this.hasGrid) this.chooseAxes();
        this.restore();
        this.addToolbar();
        host.append(this.panels);
    }

    /// A grid with random items needs all of them for its means.
    private get hasGrid() { return this.sweep.isGrid || (this.sweep.isMixed && this.sweep.isComplete && this.sweep.measures.length > 0); }

    /// Starts with the two axes that have the largest effects.
    private chooseAxes() {
        const [x, y] = variedAxes(this.sweep, this.choice.measure);
        [this.grid.x, this.grid.y] = [x ?? 0, y ?? 0];
    }

    private addToolbar() {
        const {measures, data, isGrid} = this.sweep, {choice} = this, bar = h("div", {class: "toolbar", id: "toolbar"});
        const add = (id: string, one: HTMLLabelElement) => { one.querySelector("select")!.id = id; bar.append(one); };
        if (measures.length > 1) add("measure", chooser("Measure", measures.map(({name}) => name), choice.measure, (k) => { choice.measure = k; this.draw(); }));
        if (data.groupings.length > 1 && (!isGrid || data.rasters.length || data.traces.length))
            add("grouping", chooser("Colour by", data.groupings.map(({name}) => name), choice.grouping, (k) => { choice.grouping = k; this.draw(); }));
        bar.append(this.axes);
        this.host.append(bar);
    }

    /// Reads the selection from the link; unknown names are ignored.
    private restore() {
        const values = linkValues(), {sweep, choice, grid} = this, index = (names: string[], name?: string) => (name === undefined ? -1 : names.indexOf(name));
        const measure = index(sweep.measures.map(({name}) => name), values?.get("measure")), grouping = index(sweep.data.groupings.map(({name}) => name), values?.get("colour"));
        if (measure >= 0) choice.measure = measure;
        if (grouping >= 0) choice.grouping = grouping;
        const names = sweep.summary.axes.map(({name}) => name), [x, y] = [index(names, values?.get("across")), index(names, values?.get("up"))];
        if (x >= 0 && y >= 0 && x !== y) [grid.x, grid.y] = [x, y];
        (values?.get("at") || "").split(",").forEach((text, a) => {
            if (a < names.length && text !== "") grid.fixed[a] = sweep.levels(a).find((level) => plainNumber(level) === Number(text)) ?? null;
        });
    }

    private store() {
        const {sweep, choice, grid} = this, {axes} = sweep.summary;
        setLink({measure: choice.measure ? sweep.measures[choice.measure].name : null, colour: choice.grouping ? sweep.data.groupings[choice.grouping].name : null,
                 ...(this.hasGrid && axes.length > 1 ? {across: axes[grid.x].name, up: axes[grid.y].name, at: grid.fixed.some((v) => v !== null) ? grid.fixed.map((v) => (v === null ? "" : plainNumber(v))).join(",") : null} : {})});
    }

    draw() {
        const {sweep, choice, grid, panels} = this, {data} = sweep, group = (id: string, title: string) => section(panels, id, title);
        fill(panels);
        const redraw = () => { this.draw(); this.store(); };
        const columns = h("div", {class: sweep.isGrid ? "columns thirds" : "columns"});
        panels.append(columns);
        if (sweep.isGrid && sweep.measures.length) {
            axisChoosers(this.axes, sweep, choice.measure, grid, redraw);
            showGridFigures(columns, sweep, choice.measure, grid);
            const effects = h("div", {class: "columns thirds"});
            showMainEffects(effects, sweep, choice.measure);
            if (effects.childElementCount) section(panels, "effects", `Effect of each axis on ${sweep.measures[choice.measure].name}`, "mean at each value, over all values of the other axes").append(effects);
        } else if (sweep.measures.length) {
            showHistogram(columns, sweep, choice);
            showNormalPlot(columns, sweep, choice);
            for (const factor of data.factors[choice.measure] || []) showFactor(columns, sweep, choice, factor);
            if (sweep.isMixed && !sweep.isComplete) columns.append(h("p", {class: "note"}, "The sweep has too many items for the page to show their means over the grid."));
            if (this.hasGrid) {
                axisChoosers(this.axes, sweep, choice.measure, grid, redraw);
                const means = h("div", {class: "columns thirds"});
                group("means", `Means of ${sweep.measures[choice.measure].name} at the grid points`).append(means);
                showGridFigures(means, sweep, choice.measure, grid);
            }
        }
        if (data.rasters.length) data.rasters.forEach((train, k) => showRaster(k ? panels : group("rasters", "Spikes"), sweep, choice, train));
        if (data.traces.length) {
            const traces = h("div", {class: "columns"});
            group("traces", "Traces").append(traces);
            for (const trace of data.traces) showEnvelope(traces, sweep, choice, trace);
        }
        forgetRemoved();
        this.drawExtremes();
        this.store();
    }

    showExtremes(host: Element) {
        if (this.sweep.measures.length) this.extremes = host.appendChild(h("div", {}));
    }

    private drawExtremes() {
        if (!this.extremes) return;
        const {sweep, choice: {measure}} = this, hint = sweep.data.single_chip_hint;
        fill(this.extremes);
        section(this.extremes, "extremes", `Items with the smallest and largest ${sweep.measures[measure].name}`).append(itemTable("extreme items", sweep, sweep.data.extremes[measure]), hint ? h("p", {class: "note"}, hint) : "");
    }
}
