// The figures of the first screen: force, spikes and rates of one channel, and an overview of all channels.

import {mixed} from "../../base/colours";
import {quantity, symbol} from "../../base/text";
import type {ChannelData, InputData, RespondData} from "../../data/document";
import {isNarrow} from "../../base/dom";
import {FrequencyPanel} from "../../panels/frequency-panel";
import {HeatPanel, heatHeight} from "../../panels/heat-panel";
import {RasterPanel, Row, rasterHeight} from "../../panels/raster-panel";
import {RatePanel, dashOf, equalBins} from "../../panels/rate-panel";
import {Spikes, Trace, endOf} from "../../panels/signals";
import {TracePanel} from "../../panels/trace-panel";
import type {Panel} from "../../plot/panel";
import {AfferentType, Member} from "./implementations";

const MIN_HEAT_CHANNELS = 5;  // with fewer, the force of each is read in its own panel

export interface ChannelRow extends Row { channel: ChannelData }

export class FirstFigures {
    private spikeTrains: Map<string, Spikes>;

    constructor(private data: RespondData, private types: AfferentType[]) {
        this.spikeTrains = new Map(data.spikes.map((one) => [`${one.afferent}\n${one.channel}`, new Spikes(one)]));
    }

    spikes(name: string, {id}: ChannelData) { return this.spikeTrains.get(`${name}\n${id}`) || new Spikes(null); }

    /// The names whose spike trains are shown for an afferent: its own, or those of its first copies.
    copiesOf({afferent}: Member): string[] {
        const {copies} = this.data;
        return copies ? Array.from({length: copies.shown}, (_, k) => `${afferent.name}#${k + 1}`) : [afferent.name];
    }

    private get members() { return this.types.flatMap((type) => type.members); }

    /// The channel of an input with the most spikes. It is shown first, because the first channel of many may have no force.
    mostActiveChannel(input: InputData): ChannelData {
        const count = (channel: ChannelData) => this.members.flatMap((one) => this.copiesOf(one)).reduce((sum, name) => sum + this.spikes(name, channel).count, 0);
        return input.channels.reduce((best, channel) => (count(channel) > count(best) ? channel : best));
    }

    /// `traces`: of the channel. `pick`: shows another channel.
    panels(host: Element, input: InputData, channel: ChannelData, traces: Trace[], pick: (channel: ChannelData) => void): Panel[] {
        return [...this.forcePanels(host, input, channel, traces, pick), ...this.spikePanels(host, input, channel, traces.length === 0, pick)];
    }

    private forcePanels(host: Element, input: InputData, channel: ChannelData, traces: Trace[], pick: (channel: ChannelData) => void): Panel[] {
        const groups = new Map<string, Trace[]>(), panels: Panel[] = [];
        for (const trace of traces.filter((one) => one.afferent === null)) groups.set(trace.unit, [...(groups.get(trace.unit) || []), trace]);
        for (const group of groups.values()) {
            const names = group.map((trace) => trace.quantity).join(", ");
            panels.push(new TracePanel({host, phases: input.phases, traces: group, name: group[0].quantity, title: [names], about: names, height: 96, isNamed: panels.length === 0,
                series: group.map(({quantity}, k) => ({name: quantity, label: group.length > 1 ? symbol(quantity) : [], width: 1.6, colour: mixed("var(--ink)", "var(--faint)", k / group.length)}))}));
        }
        const all = input.channels.map((one) => this.data.traces.find((record) => record.channel === one.id && record.afferent === null));
        if (input.channels.length >= MIN_HEAT_CHANNELS && all.every((one) => one && one.unit === all[0]!.unit)) {
            const rows = input.channels.map((one, k) => ({channel: one, label: short(channelName(input, one)), isChosen: one === channel, trace: new Trace(all[k]!, input)}));
            panels.push(new HeatPanel({host, name: "all forces", title: [`${all[0]!.quantity} on all channels`], about: "force on all channels", height: heatHeight(rows.length), rows, pick: (row) => pick(row.channel)}));
        }
        return panels;
    }

    private spikePanels(host: Element, input: InputData, channel: ChannelData, isNamed: boolean, pick: (channel: ChannelData) => void): Panel[] {
        if (!this.data.afferents.length) return [];
        const {copies} = this.data, {phases} = input, areAll = input.channels.length > 1 && !copies, areSeveral = this.types.some(({members}) => members.length > 1);
        const series = this.members.sort((one, other) => one.index - other.index).map(({afferent, colour}) => ({name: afferent.name, colour, width: 3})), rows = this.rows(input, channel);
        const title = copies ? copies.shown === copies.count ? `spikes of all ${copies.count} copies` : `spikes of the first ${copies.shown} of ${copies.count} copies; counts of these`
            : areAll ? `spikes on all channels; counts on ${channelName(input, channel)}` : "spikes";
        const raster = new RasterPanel<ChannelRow>({host, phases, name: "raster", title: [title], about: title, height: rasterHeight(rows.length, rows.length > 12 ? (areAll ? 200 : 240) : 288), isNamed, rows, series, isBottom: true,
            isGrouped: areAll || Boolean(copies) || areSeveral, pick: areAll ? (row) => pick(row.channel) : null});
        return [raster, ...(copies ? [this.copiesPanel(host, input, channel)] : []), ...this.frequencyPanels(host, input, channel)];
    }

    /// The rate of each afferent in bins, as the mean over all copies.
    private copiesPanel(host: Element, input: InputData, channel: ChannelData): Panel {
        const {count, rates} = this.data.copies!, end = endOf(input);
        const curves = this.members.map(({afferent: {name}, index, colour}) => {
            const {bin, values} = rates.find((one) => one.afferent === name && one.channel === channel.id)!;
            return {name, colour, width: 1.6, dash: dashOf(index), edges: equalBins(input.t0, bin, values.length, end), values};
        });
        const title = `mean rate of all ${count} copies`, bins = `, in bins of ${quantity(rates[0].bin, "s", true)}`;
        return new RatePanel({host, phases: input.phases, name: "population", title: [title + bins], about: title, height: 100, curves, isBottom: true});
    }

    /// One panel; with several implementations of a type, one for each type.
    private frequencyPanels(host: Element, input: InputData, channel: ChannelData): Panel[] {
        const areApart = this.types.length > 1 && this.types.some(({members}) => members.length > 1);
        const lists = areApart ? this.types.map(({name, members}) => ({prefix: `${members.length > 1 ? name : members[0].afferent.name} `, members})) : [{prefix: "", members: this.members}];
        const where = this.data.copies ? " of copy 1" : input.channels.length > 1 ? ` on ${channelName(input, channel)}` : "";
        return lists.map(({prefix, members}) => new FrequencyPanel({host, phases: input.phases, name: `${prefix}frequency`, title: [`${prefix}instantaneous frequency${where}`],
            about: `${prefix}instantaneous frequency${where}`, height: areApart ? 96 : 120, isBottom: true,
            trains: members.map((one) => ({name: one.afferent.name, colour: one.colour, shape: one.index, spikes: this.spikes(this.copiesOf(one)[0], channel)}))}));
    }

    /// The rows of the raster: every afferent on every channel, or the shown copies of every afferent on the channel. With several implementations on
    /// several channels, the implementations on one channel are adjacent if there is space for labels.
    private rows(input: InputData, chosen: ChannelData): ChannelRow[] {
        const isOne = Boolean(this.data.copies), channels = isOne ? [chosen] : input.channels, areAll = channels.length > 1;
        const rowsOf = (member: Member, on: ChannelData[], group: string) => on.flatMap((channel) => this.copiesOf(member).map((name): ChannelRow => {
            const about = areAll ? `${name} ${channelName(input, channel)}` : name;
            return {series: member.afferent.name, group, channel, isChosen: channel === chosen, colour: member.colour, spikes: this.spikes(name, channel), label: areAll && isNarrow() ? channelName(input, channel) : short(about), about};
        }));
        return this.types.flatMap(({name, members}) => (members.length > 1 && areAll && this.data.afferents.length * channels.length <= 46
            ? channels.flatMap((channel) => members.flatMap((one) => rowsOf(one, [channel], `${name} ${channel.id}`)))
            : members.flatMap((one) => rowsOf(one, channels, areAll || isOne ? one.afferent.name : name))));
    }
}

/// The name of a channel without that of its input.
export const channelName = (input: InputData, {name}: ChannelData) => (name.startsWith(`${input.name}:`) ? name.slice(input.name.length + 1) : name);

/// The end of a long label.
function short(text: string): string {
    const most = isNarrow() ? 11 : 18;
    return text.length > most ? `…${text.slice(1 - most)}` : text;
}
