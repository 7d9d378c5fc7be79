// A recording, or a named stimulus, under the rows of the page: read by the engine, simulated, and shown like a report.

import {append, chooser, fill, h} from "../base/dom";
import {quantity} from "../base/text";
import {RasterPanel} from "../panels/raster-panel";
import {TracePanel} from "../panels/trace-panel";
import {View} from "../plot/view";
import type {Answer} from "./engine";
import {LiveCurve, LiveTrain, appendSpikes} from "./history";
import type {Session} from "./session";
import {settingTexts} from "./settings";

export class Recording {
    readonly root = h("div", {id: "recording"});
    private result = h("div");
    private status = h("p", {class: "readout", role: "status", id: "recording-status"});
    private view: View | null = null;
    private rate: HTMLInputElement = h("input", {type: "text", id: "recording-rate", size: 8, placeholder: "1kHz"});
    private scale: HTMLInputElement = h("input", {type: "text", id: "recording-scale", size: 8, placeholder: "1"});

    constructor(private session: Session) {
        const file: HTMLInputElement = h("input", {type: "file", id: "recording-file", "aria-label": "Recording", onchange: () => {
            const chosen = file.files![0];
            if (chosen) void this.load(chosen);
            file.value = "";  // so that the same file can be chosen again
        }});
        const names = session.catalogue.stimuli.map(({name}) => name);
        const runStimulus = (name: string) => {
            fill(this.result);
            void this.run({stimulus: name}, {}, name);
        };
        let chosen = Math.max(0, names.indexOf("press"));
        const stimulus = chooser("or a stimulus", names, chosen, (k) => runStimulus(names[chosen = k]));
        const play = h("button", {type: "button", id: "play-stimulus", onclick: () => runStimulus(names[chosen])}, "Play");
        append(this.root, h("p", {}, h("label", {}, "Recording ", file), " ", stimulus, " ", play),
            h("p", {class: "bar"}, h("label", {title: "--rate: for a file without a column of times"}, "Rate ", this.rate), h("label", {title: "--scale: newtons per unit of the file"}, "Scale ", this.scale), "Set these before you choose the file."),
            h("p", {class: "note"}, `A table of forces (CSV and other formats of the command line). It is read and simulated by ${session.engine.place}; it is not sent anywhere else.`), this.status, this.result);
        this.root.addEventListener("dragover", (event) => event.preventDefault());
        this.root.addEventListener("drop", (event) => {
            event.preventDefault();
            const dropped = event.dataTransfer?.files[0];
            if (dropped) void this.load(dropped);
        });
    }

    private async load(file: File) {
        try {
            this.session.engine.checkLength(file.size);
            const typed = Object.entries({rate: this.rate.value.trim(), scale: this.scale.value.trim()}).filter(([, text]) => text);
            const answer = await this.session.engine.request({request: "read", name: file.name, options: Object.fromEntries(typed)}, {file: new Uint8Array(await file.arrayBuffer())});
            this.showChannels(answer, file.name);
        } catch (error) {
            this.status.textContent = (error as Error).message;
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
        const {settings, rows: shown} = this.session, trains = settings.rows.map(() => new LiveTrain()), colours = shown.map(({colour}) => colour);
        const rows = settings.rows.map(({afferent, set}) => ({afferent, set: settingTexts(set)}));
        try {
            await this.session.runJob({request: "respond", rate: settings.rate, seed: settings.seed, rows, ...force}, arrays, (answer) => {
                appendSpikes(trains, answer.arrays.unit, answer.arrays.time);
                this.status.textContent = `${name}: ${Math.round(100 * answer.head.progress)} % simulated`;
                if (answer.head.done) this.show(answer, arrays.force || answer.arrays.force, trains, colours, name);
            });
        } catch (error) {
            this.status.textContent = (error as Error).message;
        }
    }

    private show({head}: Answer, values: ArrayLike<number>, trains: LiveTrain[], colours: string[], name: string) {
        const host = this.result.querySelector<HTMLElement>(".figures") || this.result.appendChild(h("div", {class: "figures"})), {rate, samples, phases = []} = head;
        const curve = new LiveCurve("force", "N", 1 / rate, null, 0, samples), clock = {t0: 0, T: 1 / rate, samples};
        curve.append(values, 0);
        this.view?.remove();
        const view = this.view = new View();
        view.setLimits({begin: 0, end: samples / rate, smallest: 4 / rate});
        view.add(new TracePanel({host, name: "recorded force", title: ["force"], about: `force of ${name}`, height: 100, clock, phases, isNamed: true, traces: [curve], series: [{name: "force", label: [], colour: "var(--ink)"}]}),
            new RasterPanel({host, name: "recorded spikes", title: ["spikes"], about: `spikes under ${name}`, height: Math.max(50, 24 * trains.length), clock, phases, isBottom: true, series: [],
                             rows: head.rows.map((row: {name: string}, k: number) => ({series: row.name, label: row.name, colour: colours[k], spikes: trains[k]}))}));
        this.status.textContent = `${name}: ${quantity(samples / rate, "s", true)}; ` + head.rows.map((row: {name: string}, k: number) => `${row.name} ${trains[k].count}`).join(", ") + " spikes";
    }
}
