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

/// The options of a command line by their names: "--abs -c Fz --notch=50Hz --notch 100Hz" is {abs: ["true"], channel: ["Fz"], notch: ["50Hz", "100Hz"]}.
/// A value with blanks is between quotation marks. Throws an error if a word is neither an option nor the value of one.
function optionTexts(line: string): Record<string, string[]> {
    const words = (line.match(/(?:"[^"]*"|[^\s"])+/g) || []).map((word) => word.replace(/"/g, "")), isOption = (word: string) => /^--?[a-z]/.test(word);
    const options = new Map<string, string[]>();
    for (let k = 0; k < words.length; ++k) {
        const [, name, value] = words[k].match(/^--?([a-z][a-z-]*)(?:=(.*))?$/) || [];
        if (!name) throw new Error(`options of the recording: '${words[k]}' is not an option; write for example --rate 1kHz`);
        const full = name === "c" ? "channel" : name, hasNoValue = k + 1 === words.length || isOption(words[k + 1]);
        options.set(full, [...(options.get(full) || []), value ?? (hasNoValue ? "true" : words[++k])]);
    }
    return Object.fromEntries(options);
}

export class Recording {
    readonly root = h("div", {id: "recording"});
    private result = h("div");
    private status = h("p", {class: "readout", role: "status", id: "recording-status"});
    private view: View | null = null;
    private options: HTMLInputElement = h("input", {type: "text", id: "recording-options", size: 40, spellcheck: false,
        placeholder: "--rate 1kHz --scale 0.01 --channel Fz", onchange: () => this.read(this.file)});
    private file: File | undefined;  // the last one
    private newest = 0;              // number of the newest recording or stimulus

    constructor(private session: Session) {
        const input: HTMLInputElement = h("input", {type: "file", id: "recording-file", "aria-label": "Recording", onchange: () => {
            this.read(input.files![0]);
            input.value = "";  // so that the same file can be chosen again
        }});
        const names = session.catalogue.stimuli.map(({name}) => name);
        const runStimulus = (name: string) => {
            fill(this.result);
            void this.run({stimulus: name}, {}, name);
        };
        let chosen = Math.max(0, names.indexOf("press"));
        const stimulus = chooser("or a stimulus", names, chosen, (k) => runStimulus(names[chosen = k]));
        const play = h("button", {type: "button", id: "play-stimulus", onclick: () => runStimulus(names[chosen])}, "Play");
        append(this.root, h("p", {}, h("label", {}, "Recording ", input), " ", stimulus, " ", play),
            h("p", {class: "bar"}, h("label", {title: "how the file is read: options of `corpuscle respond` for recordings"}, "Options of the recording ", this.options)),
            h("p", {class: "note"}, `A table of forces: ${session.engine.formats}. It is read and simulated by ${session.engine.place}; it is not sent anywhere else.`), this.status, this.result);
        this.root.addEventListener("dragover", (event) => event.preventDefault());
        this.root.addEventListener("drop", (event) => {
            event.preventDefault();
            this.read(event.dataTransfer?.files[0]);
        });
    }

    private read(file: File | undefined) {
        if (file) void this.load(this.file = file);
    }

    private async load(file: File) {
        try {
            this.session.engine.checkLength(file.size);
            const answer = await this.session.engine.request({request: "read", name: file.name, options: optionTexts(this.options.value)},
                {file: new Uint8Array(await file.arrayBuffer())});
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
        const rows = settings.rows.map(({afferent, set}) => ({afferent, set: settingTexts(set)})), number = ++this.newest;
        this.status.textContent = `${name}: 0 % simulated`;
        try {
            const isDone = await this.session.runJob({request: "respond", rate: settings.rate, seed: settings.seed, rows, ...force}, arrays, (answer) => {
                appendSpikes(trains, answer.arrays.unit, answer.arrays.time);
                this.status.textContent = `${name}: ${Math.round(100 * answer.head.progress)} % simulated`;
                if (answer.head.done) this.show(answer, arrays.force || answer.arrays.force, trains, colours, name);
            });
            if (!isDone && number === this.newest) this.status.textContent += ", stopped by another simulation";
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
        const problems = [...head.warnings, ...head.rows.filter((row: {error?: string}) => row.error).map(({name: row, error}: any) => `${row}: ${error}`)];
        if (problems.length) this.status.textContent += `. ${problems.join(". ")}`;
    }
}
