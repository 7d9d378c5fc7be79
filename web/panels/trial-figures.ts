// Trials, aligned: the force of each, the spikes of one afferent, and their histogram over the trials of each label (PSTH).

import {decoded} from "../base/arrays";
import {seriesColour} from "../base/colours";
import {chooser, h} from "../base/dom";
import {quantity} from "../base/text";
import type {TrialData, TrialsData} from "../data/document";
import {connectKeys} from "../plot/pointer";
import type {Series} from "../plot/panel";
import {View} from "../plot/view";
import {RasterPanel, Row} from "./raster-panel";
import {RatePanel} from "./rate-panel";
import {Spikes, Trace} from "./signals";
import {TracePanel} from "./trace-panel";

interface TrialRow extends Row { trial: number }

export interface TrialFigureOptions {
    choices?: string[];                           ///< texts of the groups, else name and channel
    rowsHeight?: number;                          ///< of the raster, at most, pixels
    pick?: ((trial: TrialData) => void) | null;   ///< called when a row of the raster is chosen
    groupsOf?: (choice: number) => number[];      ///< groups of which a choice shows the rates, without rasters; else the group with its index
    noun?: string;                                ///< of a choice, "Afferent" unless given
    firstColour?: number;                         ///< of the labels, an index
}

export class TrialFigures {
    readonly view = new View();
    private order: number[];  // trials, sorted by label
    private plots = h("div");
    private spikes = new Map<number, Spikes[]>();  // by group, of each trial
    group: number;

    constructor(host: Element, private data: TrialsData, private options: TrialFigureOptions = {}) {
        this.order = data.trials.map((_, t) => t).sort((a, b) => this.label(a) - this.label(b) || a - b);
        this.group = options.groupsOf ? 0 : this.mostActive();
        const names = options.choices || data.groups.map(({name, channel}) => `${name} ${channel}`);
        host.append(h("div", {class: "trial-choice"}, names.length > 1 && chooser(options.noun || "Afferent", names, this.group, (group) => this.show(group)),
                      h("button", {type: "button", onclick: () => this.view.reset()}, "Reset")), this.plots);
        connectKeys(this.view, host);
        const aligned = data.trials.filter(({zero}) => zero !== null);
        if (!aligned.length) {
            this.plots.append("No trial has a contact onset.");
            return;
        }
        this.view.setLimits({begin: Math.min(...aligned.map(({from}) => from)), end: Math.max(...aligned.map(({to}) => to)), smallest: data.bin / 50});
        this.show(this.group);
    }

    private label(trial: number) { return this.data.labels.indexOf(this.data.trials[trial].label); }

    private series(): Series[] {
        return this.data.labels.map((name, k) => ({name, label: [`${name} (${this.data.trials.filter((one) => one.label === name).length})`], colour: seriesColour(k + (this.options.firstColour || 0))}));
    }

    /// The group with the most spikes; without spikes, that with the highest rate.
    private mostActive(): number {
        const {groups, spikes, histograms} = this.data, activity = groups.map(() => 0);
        if (spikes) for (const {group, times} of spikes) activity[group] += Object.values(times)[0]!.length;
        else for (const {group, rate} of histograms) activity[group] += rate.reduce((sum: number, v) => sum + (v || 0), 0);
        return Math.max(0, activity.indexOf(Math.max(...activity)));
    }

    /// Shows the spikes and rates of a group.
    show(group: number) {
        this.group = group;
        const {a, b} = this.view, hidden = new Map(this.view.panels.map((panel) => [panel.name, [...panel.hidden]]));
        this.view.clear();
        const force = this.forcePanel(), {groupsOf} = this.options, raster = this.data.spikes && !groupsOf ? [this.rasterPanel(group)] : [];
        const rates = groupsOf ? groupsOf(group).map((one, k, all) => this.ratePanel(one, `trial rate ${this.data.groups[one].name}`, k === all.length - 1)) : [this.ratePanel(group)];
        this.view.add(force, ...raster, ...rates);
        for (const panel of this.view.panels) panel.onToggle = (name) => this.view.panels.forEach((one) => one.toggle(name));  // a label in all
        for (const panel of this.view.panels) for (const name of hidden.get(panel.name) || []) panel.toggle(name);
        this.view.set(a, b);
    }

    private forcePanel() {
        const shown = this.order.filter((t) => this.data.trials[t].zero !== null && this.data.trials[t].force.values);
        const traces = shown.map((t) => {
            const {from, step, values} = this.data.trials[t].force, count = decoded(values).length;
            return new Trace({channel: 0, afferent: null, quantity: `force of trial ${t + 1}`, unit: "N", bucket: 1, count, data: values}, {t0: from + step / 2, T: step, samples: count});
        });
        return new TracePanel({host: this.plots, name: "trial force", title: ["force"], about: "force of the trials", height: 96, zero: 0, traces, owners: shown.map((t) => this.label(t)), series: this.series()});
    }

    /// The spikes of a group in each trial, of all its afferents together.
    private spikesOf(group: number): Spikes[] {
        const known = this.spikes.get(group);
        if (known) return known;
        const times = this.data.trials.map(() => [] as number[]);
        for (const one of this.data.spikes!) if (one.group === group) times[one.trial].push(...decoded(one.times));
        const all = times.map((list) => new Spikes(Float64Array.from(list).sort()));
        this.spikes.set(group, all);
        return all;
    }

    private rasterPanel(group: number) {
        const {trials} = this.data, spikes = this.spikesOf(group), isOfInputs = new Set(trials.map(({input}) => input)).size === trials.length;
        const rows = this.order.map((trial): TrialRow => {
            const {label, input, zero} = trials[trial], name = isOfInputs ? input : `${trial + 1}`, about = isOfInputs ? input : `trial ${trial + 1}, ${label}`;
            return {trial, series: label, group: label, label: zero === null ? "no contact" : name.length > 18 ? `…${name.slice(-17)}` : name, about: zero === null ? `${about}: no contact` : about,
                    colour: seriesColour(this.label(trial)), spikes: spikes[trial]};
        });
        const {pick} = this.options, limit = this.options.rowsHeight || 420;
        return new RasterPanel<TrialRow>({host: this.plots, name: "trial raster", title: [isOfInputs ? "spikes of each input" : "spikes of each trial"], about: "spikes of the trials",
                                height: Math.max(60, Math.min(limit, rows.length * 13)), zero: 0, rows, series: this.series(), isGrouped: true, pick: pick && ((row) => pick(trials[row.trial]))});
    }

    private ratePanel(group: number, panelName = "trial rate", isBottom = true) {
        const {histograms, groups, bin, labels} = this.data, {name, afferents} = groups[group], series = this.series();
        const curves = histograms.filter((one) => one.group === group).map(({label, edges, end, rate, error}) =>
            ({...series[labels.indexOf(label)], edges: [...edges, end], values: rate, errors: error}));
        const title = [`${name}: mean rate${afferents > 1 ? " per afferent" : ""} ± standard error, bins of ${quantity(bin, "s", true)}`];
        return new RatePanel({host: this.plots, name: panelName, title, about: `mean rate of ${name} over the trials of a label`, height: isBottom ? 130 : 100, zero: 0, curves, isBottom});
    }
}

export const trialsTitle = ({trials, onset}: TrialsData) => `${trials.length} trials, aligned to ${onset ? "contact onset" : "their start"}`;
