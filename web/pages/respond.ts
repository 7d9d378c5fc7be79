// The page of the verb `respond`: force, spikes and rates of a channel, then currents and membranes of each afferent, folded, then tables.

import {onLinkChange, setLink} from "../base/link";
import {chooser, fill, h} from "../base/dom";
import {quantity} from "../base/text";
import type {ChannelData, InputData, RespondData, TrialData} from "../data/document";
import {Trace, endOf} from "../panels/signals";
import {TrialFigures} from "../panels/trial-figures";
import type {Panel} from "../plot/panel";
import {View} from "../plot/view";
import {addNote, folded, hint, section, showVersions, startPage, timeToolbar} from "../shell";
import {aboutMember, afferentTypePanels, tracesOf} from "./respond/afferent-figures";
import {consoleAccess} from "./respond/console-access";
import {FirstFigures, channelName} from "./respond/first-figures";
import {AfferentType, afferentTypesOf} from "./respond/implementations";
import {costTables, implementationTable, parameterTables, qualityTable, rateTable} from "./respond/tables";
import {NO_VIEW, ViewState, readViewLink, viewLinkValues} from "./respond/view-link";

class RespondPage {
    readonly view = new View();
    readonly trials: TrialFigures | null;
    traces: Trace[] = [];
    input!: InputData;
    channel!: ChannelData;
    private types: AfferentType[];
    private first: FirstFigures;
    private figures = h("div", {id: "figures"});
    private choice = h("span", {class: "choice"});
    private hidden = new Set<string>();  // "panel:series"
    private open = new Set<string>();    // ids of the open sections
    private areAllRows = false;
    private showTables: ((channel: string) => void)[] = [];

    constructor(private data: RespondData) {
        this.types = afferentTypesOf(data.afferents);
        this.first = new FirstFigures(data, this.types);
        const main = startPage(data), state = readViewLink();
        this.areAllRows = Boolean(state && state.areAllRows);
        this.trials = data.trials ? this.addTrials(main) : null;
        timeToolbar(main, this.view, this.choice);
        main.append(this.figures);
        this.addTables(main);
        this.restore(state);
        for (const view of this.views) view.onDraw(() => this.keepInLink());
        onLinkChange(() => this.restore(readViewLink()));
    }

    get views() { return this.trials ? [this.trials.view, this.view] : [this.view]; }

    /// Shows the view of a link: what of it the page has.
    private restore(state: ViewState | null) {
        if (!state) addNote("The view in the link of this page is damaged, so it was ignored.");
        const {inputs} = this.data, {input: inputNumber, channel: channelNumber, from, to, isAutoscale, hidden, open} = state || NO_VIEW;
        const input = inputs[(inputNumber || 1) - 1] || inputs[0], channel = (channelNumber && input.channels[channelNumber - 1]) || this.first.mostActiveChannel(input);
        this.view.clear();
        [this.hidden, this.open] = [new Set(hidden), new Set(open)];
        this.view.setAutoscale(isAutoscale);
        this.show(input, channel);
        if (this.trials) this.hide(this.trials.view.panels);
        if (from !== null) this.view.set(from, to!);
        else this.view.reset();
    }

    /// Keeps in the link what differs from the view that the page opens with.
    private keepInLink() {
        const {inputs} = this.data, {view, input, channel} = this, digits = (t: number) => Number(t.toPrecision(9));
        this.collectHidden();
        setLink(viewLinkValues({input: input === inputs[0] ? null : inputs.indexOf(input) + 1, channel: channel === this.first.mostActiveChannel(input) ? null : input.channels.indexOf(channel) + 1,
                                from: view.isComplete ? null : digits(view.a), to: view.isComplete ? null : digits(view.b), isAutoscale: view.isAutoscale, areAllRows: this.areAllRows,
                                hidden: [...this.hidden], open: [...this.open]}));
    }

    private collectHidden() {
        for (const panel of this.views.flatMap(({panels}) => panels))
            for (const {name} of panel.series) panel.hidden.has(name) ? this.hidden.add(`${panel.name}:${name}`) : this.hidden.delete(`${panel.name}:${name}`);
    }

    /// Adds panels to the view, without the series that the user has hidden.
    private add(panels: Panel[]) {
        this.view.add(...panels);
        this.hide(panels);
    }

    private hide(panels: Panel[]) {
        for (const panel of panels) for (const {name} of panel.series) if (panel.hidden.has(name) !== this.hidden.has(`${panel.name}:${name}`)) panel.toggle(name);
    }

    /// Shows the figures and tables of one channel of an input. The visible times are kept if only the channel changes.
    show(input: InputData, channel: ChannelData) {
        const keep = this.input === input, focus = (document.activeElement?.closest("[data-panel]") as HTMLElement | null)?.dataset.panel, scroll = scrollY;
        if (this.view.panels.length) this.collectHidden();
        Object.assign(this, {input, channel, traces: this.data.traces.filter((one) => one.channel === channel.id).map((one) => new Trace(one, input))});
        this.view.clear();
        fill(this.figures);
        this.view.setLimits({begin: input.t0, end: endOf(input), smallest: 4 * input.T}, keep);
        const host = section(this.figures, "first", this.heading(), this.aboutFirst());
        this.add(this.first.panels(host, input, channel, this.traces, (one) => this.show(input, one)));
        host.append(hint());
        for (const type of this.types) this.addAfferentType(type);
        this.showChoice();
        this.showTables.forEach((showTable) => showTable(channel.name));
        scrollTo(0, scroll);
        const focused = this.view.panels.find(({name}) => name === focus);
        if (focused) focused.plot.focus({preventScroll: true});
    }

    private heading() { return this.data.inputs.length > 1 || this.input.channels.length > 1 ? `${this.data.inputs.length > 1 ? `${this.input.name}, ` : ""}${channelName(this.input, this.channel)}` : "Stimulus"; }

    private aboutFirst(): string {
        const {copies} = this.data, {description} = this.input;
        const traces = this.traces.length ? "" : "No traces were recorded for this channel.";
        const about = copies && (copies.has_probes ? "Currents and membranes are of copy 1." : `With more than ${copies.shown} copies currents and membranes are not recorded.`);
        return [description, about, traces].filter(Boolean).join(". ").replace("..", ".");
    }

    private addAfferentType(type: AfferentType) {
        const {members, name} = type, {input} = this;
        if (!members.some((one) => tracesOf(this.shown, one).length)) return;
        const [{colour}] = members, isOne = members.length === 1, title = isOne ? members[0].afferent.name : name;
        const about = isOne ? aboutMember(members[0], this.shown.isCopy) : members.map(({afferent}) => afferent.name).join(", ");
        const node = folded(this.figures, `afferent ${title}`, title, about, isOne ? colour : "", (host) => this.input === input && this.add(afferentTypePanels(host, type, this.shown)), this.open.has(title));
        node.addEventListener("toggle", () => {
            if (!node.isConnected) return;
            node.open ? this.open.add(title) : this.open.delete(title);
            this.view.request();
        });
    }

    private get shown() {
        return {clock: this.input, phases: this.input.phases, traces: this.traces, isCopy: Boolean(this.data.copies),
                spikesOf: (member: AfferentType["members"][0]) => this.first.spikes(this.first.copiesOf(member)[0], this.channel)};
    }

    /// The selectors of input and channel; those with a single entry are left out.
    private showChoice() {
        const {inputs} = this.data, {channels} = this.input;
        const input = inputs.length > 1 && chooser("Input", inputs.map(({name}) => name), inputs.indexOf(this.input), (k) => this.show(inputs[k], this.first.mostActiveChannel(inputs[k])));
        const channel = channels.length > 1 && chooser("Channel", channels.map((one) => channelName(this.input, one)), channels.indexOf(this.channel), (k) => this.show(this.input, channels[k]));
        if (input) input.querySelector("select")!.id = "input";
        if (channel) channel.querySelector("select")!.id = "channel";
        fill(this.choice, input, channel);
    }

    private addTrials(main: Element): TrialFigures {
        const data = this.data.trials!, {trials, onset} = data, areInputs = this.data.inputs.length === trials.length;
        const about = `${trials.length} ${areInputs ? "inputs" : "trials"}, aligned to ${onset ? "contact onset" : "their start"}; rates in bins of ${quantity(data.bin, "s", true)}. A click on a row shows its ${areInputs ? "input" : "times"} below.`;
        return new TrialFigures(section(main, "trials", areInputs ? "All inputs" : "Trials", about), data, {rowsHeight: 288, pick: (trial) => this.showTrial(trial)});
    }

    /// Shows the input of a trial, and its times.
    private showTrial({input: name, zero, from, to}: TrialData) {
        const input = this.data.inputs.find((one) => one.name === name);
        if (!input) return;
        if (input !== this.input) this.show(input, this.first.mostActiveChannel(input));
        if (zero !== null) this.view.set(zero + from, zero + to);
        this.figures.scrollIntoView({block: "nearest"});
    }

    private addTables(main: Element) {
        const {data} = this, channels = data.inputs.reduce((sum, one) => sum + one.channels.length, 0);
        this.showTables = [rateTable(main, data.table, channels, this.areAllRows, (areAll) => { this.areAllRows = areAll; this.view.request(); }), implementationTable(main, data.comparisons)];
        qualityTable(main, data.quality);
        costTables(main, data.costs, data.afferents);
        parameterTables(main, data.afferents);
        showVersions(main, data.versions);
    }
}

export function showRespondPage(data: RespondData) { Object.assign(window, {corpuscle: consoleAccess(new RespondPage(data))}); }
