// A recording, or a named stimulus, under the rows of the page: read by the engine, simulated, and shown like a report.

import {append, chooser, fill, h} from "../base/dom";
import {quantity} from "../base/text";
import {RasterPanel} from "../panels/raster-panel";
import {TracePanel} from "../panels/trace-panel";
import {View} from "../plot/view";
import type {Answer} from "./engine";
import {LiveCurve, LiveTrain, appendSpikes} from "./history";
import type {Session} from "./session";
import {engineSettings} from "./settings";

const LARGEST_FILE = 64 << 20;  // bytes

export class Recording {
    readonly root = h("div", {id: "recording"});
    private result = h("div");
    private say = h("p", {class: "readout", role: "status", id: "recording-status"});
    private isRunning = false;

    constructor(private session: Session) {
        const file: HTMLInputElement = h("input", {type: "file", id: "recording-file", "aria-label": "Recording", onchange: () => { if (file.files![0]) void this.load(file.files![0]); }});
        const names = session.catalogue.stimuli.map(({name}) => name);
        const stimulus = chooser("or a stimulus", names, Math.max(0, names.indexOf("press")), (k) => void this.run({stimulus: names[k]}, {}, names[k]));
        append(this.root, h("p", {}, h("label", {}, "Recording ", file), " ", stimulus),
            h("p", {class: "note"}, "A table of forces (CSV and other formats of the command line). It is read and simulated here; nothing is sent anywhere."), this.say, this.result);
        this.root.addEventListener("dragover", (event) => event.preventDefault());
        this.root.addEventListener("drop", (event) => {
            event.preventDefault();
            const dropped = event.dataTransfer?.files[0];
            if (dropped) void this.load(dropped);
        });
    }

    private async load(file: File) {
        try {
            if (file.size > LARGEST_FILE) throw new Error(`${file.name} has ${Math.round(file.size / 2 ** 20)} MB; this page reads at most ${LARGEST_FILE / 2 ** 20} MB. The command corpuscle respond reads larger ones.`);
            const answer = await this.session.engine.request({request: "read", name: file.name}, {file: new Uint8Array(await file.arrayBuffer())});
            this.showChannels(answer, file.name);
        } catch (error) {
            this.say.textContent = (error as Error).message;
        }
    }

    /// Simulates the first channel, and lets the user choose another.
    private showChannels({head, arrays}: Answer, name: string) {
        const channels: string[] = head.channels, notes = [...(head.warnings || []), ...(head.notes || [])];
        const run = (k: number) => void this.run({rate: head.rate}, {force: arrays[`force.${k}`]}, channels.length > 1 ? `${name}, ${channels[k]}` : name);
        fill(this.result, channels.length > 1 ? h("p", {}, chooser("Channel", channels, 0, run)) : null, ...notes.map((text) => h("p", {class: "note"}, text)), h("div", {class: "figures"}));
        run(0);
    }

    private async run(force: object, arrays: {force?: any}, name: string) {
        if (this.isRunning) return;
        this.isRunning = true;
        const {engine, settings} = this.session, trains = settings.rows.map(() => new LiveTrain());
        const rows = settings.rows.map(({afferent, set}) => ({afferent, set: engineSettings(set)}));
        try {
            let answer = await engine.request({request: "respond", rate: settings.rate, seed: settings.seed, rows, slice: 0.03, ...force}, arrays);
            for (;; answer = await engine.request({request: "continue", slice: 0.03})) {
                appendSpikes(trains, answer.arrays.unit, answer.arrays.time);
                this.say.textContent = `${name}: ${Math.round(100 * answer.head.progress)} % simulated`;
                if (answer.head.done) break;
            }
            this.show(answer, arrays.force || answer.arrays.force, trains, name);
        } catch (error) {
            this.say.textContent = (error as Error).message;
        }
        this.isRunning = false;
    }

    private show({head}: Answer, values: ArrayLike<number>, trains: LiveTrain[], name: string) {
        const host = this.result.querySelector<HTMLElement>(".figures") || this.result.appendChild(h("div", {class: "figures"})), {rate, samples, phases = []} = head;
        const curve = new LiveCurve("force", "N", 1 / rate, null, 0, samples), clock = {t0: 0, T: 1 / rate, samples}, view = new View();
        curve.append(values, 0);
        fill(host);
        view.setLimits({begin: 0, end: samples / rate, smallest: 4 / rate});
        view.add(new TracePanel({host, name: "recorded force", title: ["force"], about: `force of ${name}`, height: 100, clock, phases, isNamed: true, traces: [curve], series: [{name: "force", label: [], colour: "var(--ink)"}]}),
            new RasterPanel({host, name: "recorded spikes", title: ["spikes"], about: `spikes under ${name}`, height: Math.max(50, 24 * trains.length), clock, phases, isBottom: true, series: [],
                             rows: head.rows.map((row: {name: string}, k: number) => ({series: row.name, label: row.name, colour: this.session.rows[k].colour, spikes: trains[k]}))}));
        this.say.textContent = `${name}: ${quantity(samples / rate, "s", true)}; ` + head.rows.map((row: {name: string}, k: number) => `${row.name} ${trains[k].count}`).join(", ") + " spikes";
    }
}
