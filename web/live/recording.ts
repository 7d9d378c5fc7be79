// A recording, or a named stimulus, under the rows of the page: read by the engine, simulated, and shown like a report.

import {append, chooser, download, fill, h} from "../base/dom";
import {quantity} from "../base/text";
import {RasterPanel} from "../panels/raster-panel";
import {TracePanel} from "../panels/trace-panel";
import {View} from "../plot/view";
import type {Answer} from "./engine";
import {LiveCurve, LiveTrain, appendSpikes} from "./history";
import {optionTexts} from "./option-texts";
import type {Session} from "./session";
import {settingTexts} from "./settings";
import {spikesText} from "./spikes-file";

/// A force to replay. `request`: its keys in the request `respond`. `name`: for the reader. `channel`: its name in files.
interface Force { request: object; name: string; channel: string }

export class Recording {
    readonly root = h("div", {id: "recording"});
    private about = h("div");                      // the recording: chooser of the channel, notes
    private replay = h("div", {id: "replay"});     // notes, button and figures of the newest replay
    private fileName = h("span", {class: "readout", id: "recording-name"}, "or drop it here");
    private status = h("p", {class: "readout", role: "status", id: "recording-status"});
    private view: View | null = null;
    private options: HTMLInputElement = h("input", {type: "text", id: "recording-options", size: 40, spellcheck: false,
        placeholder: "--rate 1kHz --scale 0.01 --channel Fz", onchange: () => this.read(this.file), onkeydown: ({key}: KeyboardEvent) => { if (key === "Enter") this.options.blur(); }});
    private file: File | undefined;  // the last one
    private again = h("button", {type: "button", id: "replay-again", hidden: true, onclick: () => { if (this.force) void this.run(this.force); }}, "Simulate again with the changed settings");
    private force: Force | null = null;  // of the newest replay
    private replayed = "";               // its settings
    private newest = 0;              // number of the newest reading or replay; what belongs to an older one is not shown

    constructor(private session: Session) {
        const {engine, catalogue} = session;
        const input: HTMLInputElement = h("input", {type: "file", id: "recording-file", onchange: () => {
            this.read(input.files![0]);
            input.value = "";  // so that the same file can be chosen again
        }});
        const names = catalogue.stimuli.map(({name}) => name);
        const runStimulus = (name: string) => {
            const {rate} = session.settings;
            this.begin("");
            void this.run({request: {rate, stimulus: name}, name, channel: name});
        };
        let chosen = Math.max(0, names.indexOf("press"));
        const stimulus = chooser("or a stimulus", names, chosen, (k) => runStimulus(names[chosen = k]));
        const play = h("button", {type: "button", id: "play-stimulus", onclick: () => runStimulus(names[chosen])}, "Play");
        append(this.root, h("p", {}, "Recording ", h("label", {class: "file-button"}, "Choose a file", input), " ", this.fileName, " ", stimulus, " ", play),
            h("p", {class: "bar"}, h("label", {title: "how the file is read: options of `corpuscle respond` for recordings"}, "Options of the recording ", this.options)),
            h("p", {class: "note"}, `A table of forces of at most ${engine.maxMegabytes} MB: ${engine.formats}. It is read and simulated by ${engine.place}; it is not sent anywhere else.`), this.status, this.again, this.about, this.replay);
        this.root.addEventListener("dragover", (event) => event.preventDefault());
        this.root.addEventListener("drop", (event) => {
            event.preventDefault();
            this.read(event.dataTransfer?.files[0]);
        });
    }

    private read(file: File | undefined) {
        if (file) void this.load(this.file = file);
    }

    /// Removes what is shown, and stops the replay of it. Returns the number of what begins.
    private begin(text: string): number {
        this.clearReplay();
        fill(this.about);
        this.status.textContent = text;
        return ++this.newest;
    }

    /// The settings that change a replay of the same force.
    private get settingsText() {
        const {rows, seed} = this.session.settings;
        return JSON.stringify([seed, rows.map(({afferent, set}) => [afferent, settingTexts(set)])]);
    }

    /// Offers to simulate again if the settings have changed since. Called a few times a second.
    update() { this.again.hidden = this.force === null || this.replayed === this.settingsText; }

    private clearReplay() {
        this.force = null;
        this.view?.remove();
        this.view = null;
        fill(this.replay);
    }

    private async load(file: File) {
        const {engine} = this.session, number = this.begin(`reading ${file.name} …`);
        this.fileName.textContent = file.name;
        try {
            const options = optionTexts(this.options.value);
            engine.checkFile(file.size, file.name, this.options.value);
            const bytes = new Uint8Array(await file.arrayBuffer().catch(() => { throw new Error(`${file.name} cannot be read: it has changed since it was chosen, or is a folder; choose it again`); }));
            if (number !== this.newest) return;
            const {head} = await engine.request({request: "read", name: file.name, options, keep: true}, {file: bytes});
            if (number === this.newest) this.showChannels(head, file.name);
        } catch (error) {
            if (number === this.newest) this.status.textContent = (error as Error).message;
        }
    }

    /// Simulates the first channel, and lets the user choose another.
    private showChannels(head: any, file: string) {
        const channels: string[] = head.channels, notes = [...(head.warnings || []), ...(head.notes || [])];
        const run = (k: number) => void this.run({request: {channel: k}, name: channels.length > 1 ? `${file}, ${channels[k]}` : file, channel: channels[k]});
        fill(this.about, channels.length > 1 ? h("p", {}, chooser("Channel", channels, 0, run)) : null, ...notes.map((text) => h("p", {class: "note"}, text)));
        run(0);
    }

    private async run(force: Force) {
        const {settings, rows: shown} = this.session, trains = settings.rows.map(() => new LiveTrain()), colours = shown.map(({colour}) => colour);
        const rows = settings.rows.map(({afferent, set}) => ({afferent, set: settingTexts(set)})), number = ++this.newest, isNewest = () => number === this.newest;
        this.clearReplay();
        if (!rows.length) {
            this.status.textContent = "There is no afferent to simulate; choose one with Add an afferent.";
            return;
        }
        [this.force, this.replayed, this.again.hidden] = [force, this.settingsText, true];
        this.status.textContent = `${force.name}: 0 % simulated`;
        try {
            const isDone = await this.session.runJob({request: "respond", seed: settings.seed, rows, ...force.request}, {}, (answer) => {
                if (!isNewest()) return false;
                appendSpikes(trains, answer.arrays.unit, answer.arrays.time);
                this.status.textContent = `${force.name}: ${Math.round(100 * answer.head.progress)} % simulated`;
                if (answer.head.done) this.show(answer, force, trains, colours);
                return true;
            });
            if (!isDone && isNewest()) this.status.textContent += ", stopped by another simulation";
        } catch (error) {
            if (isNewest()) this.status.textContent = (error as Error).message;
        }
    }

    private show({head, arrays}: Answer, {name, channel}: Force, trains: LiveTrain[], colours: string[]) {
        const {rate, t0, samples, phases = [], warnings, notes} = head, messages: string[] = [...warnings, ...notes], names: string[] = head.rows.map((row: {name: string}) => row.name);
        const host = h("div", {class: "figures"}), curve = new LiveCurve("force", "N", 1 / rate, null, t0, samples), clock = {t0, T: 1 / rate, samples};
        curve.append(arrays.force, t0);
        append(this.replay, messages.length ? h("ul", {class: "notes all"}, ...messages.map((text) => h("li", {}, text))) : null,
            h("p", {}, h("button", {type: "button", id: "save-replay", title: "Save the spikes of this replay as CSV, as corpuscle respond --out writes them", onclick: () => download("spikes.csv", spikesText(names, channel, trains))}, "Save spikes of this replay")), host);
        const view = (window as any).corpuscle.replay = this.view = new View();
        view.setLimits({begin: t0, end: t0 + samples / rate, smallest: 4 / rate});
        view.add(new TracePanel({host, name: "recorded force", title: ["force"], about: `force of ${name}`, height: 100, clock, phases, isNamed: true, traces: [curve], series: [{name: "force", label: [], colour: "var(--ink)"}]}),
            new RasterPanel({host, name: "recorded spikes", title: ["spikes"], about: `spikes under ${name}`, height: Math.max(50, 24 * trains.length), clock, phases, isBottom: true, series: [],
                             rows: names.map((row, k) => ({series: row, label: row, colour: colours[k], spikes: trains[k]}))}));
        const failed = head.rows.filter((row: {error?: string}) => row.error).map(({name: row, error}: any) => `. ${row}: ${error}`).join("");
        this.status.textContent = `${name}: ${quantity(samples / rate, "s", true)}${t0 ? ` from ${Number(t0.toPrecision(9))} s` : ""}; ${names.map((row, k) => `${row} ${trains[k].count}`).join(", ")} spikes${failed}`;
    }
}
