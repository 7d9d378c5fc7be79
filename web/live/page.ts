// The live page: a skin to press, the afferents that feel it, and what their nerves and chips do.

import {onThemeChange} from "../base/colours";
import {append, chooser, download, fill, h} from "../base/dom";
import {quantity} from "../base/text";
import {csvText} from "../plot/panel";
import {connectKeys} from "../plot/pointer";
import {copy, folded} from "../shell";
import {Catalogue, catalogueOf} from "./catalogue";
import {Charts} from "./charts";
import type {Engine} from "./engine";
import {HISTORY} from "./history";
import {Press, stroke, tap, vibration} from "./press";
import {Recording} from "./recording";
import {Rows} from "./rows";
import {Session} from "./session";
import {Settings, defaultSettings, putSettingsInLink, settingsOfLink} from "./settings";
import {parameterControl} from "./sliders";
import {Sound} from "./sound";
import {Stage} from "./stage";

const UPDATES = 8;  // of the numbers in the rows, per second

class LivePage {
    private message = h("p", {class: "notes", role: "alert", id: "message", hidden: true});
    private status = h("span", {class: "readout", id: "status", role: "status"});
    private press = new Press();
    private session: Session;
    private stage: Stage;
    private charts: Charts;
    private rows: Rows;
    private sound = new Sound();
    private skinControls = h("div", {class: "skin-controls"});
    private chartHost = h("div", {class: "charts"});
    private frames = 0;
    private lastUpdate = 0;

    constructor(engine: Engine, private catalogue: Catalogue, settings: Settings) {
        this.session = new Session(engine, catalogue, settings, this.press, (text) => this.say(text));
        this.press.target = settings.force;
        this.stage = new Stage(this.session, this.press);
        this.charts = new Charts(this.session, this.chartHost);
        this.rows = new Rows(this.session, this.charts, () => void this.start(), () => putSettingsInLink(settings));
        this.build(engine);
    }

    private get settings() { return this.session.settings; }

    /// Shows a message; "" hides it.
    say(text: string) {
        this.message.textContent = text;
        this.message.hidden = !text;
    }

    private build(engine: Engine) {
        const main = h("main", {class: "live"}, h("section", {class: "press"}, this.stage.root, this.forceControl(), h("div", {class: "controls"}, this.programmes(), this.skinControls)),
            h("section", {class: "responses"}, this.chartHost, this.rows.root));
        append(document.body, h("header", {}, h("h1", {}, "Press a skin"), h("span", {class: "program"}, `corpuscle ${this.catalogue.version}, computed in ${engine.place}`)), this.toolbar(), this.message, main);
        folded(document.body, "recordings", "Replay a recording", "", "", (host) => host.append(new Recording(this.session).root));
        connectKeys(this.charts.view);
        onThemeChange(() => { this.stage.redraw(); this.charts.view.request(); });
    }

    private toolbar(): HTMLElement {
        const {session} = this, button = (text: string, id: string, title: string, act: (button: HTMLButtonElement) => void) => {
            const node: HTMLButtonElement = h("button", {type: "button", id, title, onclick: () => act(node)}, text);
            return node;
        };
        return h("div", {class: "toolbar", role: "toolbar", "aria-label": "simulation"},
            button("Pause", "pause", "Stop and go on", (node) => { session.isPaused = !session.isPaused; node.textContent = session.isPaused ? "Go on" : "Pause"; }),
            button("Restart", "restart", "Start again from rest", () => void this.start()),
            button("Follow", "follow", "Show the present again", () => this.charts.followAgain()),
            button("Sound off", "sound", "Hear the spikes of the rows", (node) => void this.sound.toggle().then((on) => { node.textContent = on ? "Sound on" : "Sound off"; })),
            button("Copy link", "copy-link", "Copy a link to this page with its settings", (node) => copy(location.href, node)),
            button("Save spikes", "save", "Save the spikes since the start as CSV", () => void this.save()),
            button("Save force", "save-force", "Save the force of the last minute as a recording, which corpuscle respond reads", () => download("force.csv", forceText(session))),
            this.status);
    }

    private async save() {
        try {
            const {head, arrays} = await this.session.engine.request({request: "save"});
            download(head.name, new Blob([arrays.file]));
        } catch (error) {
            this.say((error as Error).message);
        }
    }

    private forceControl(): HTMLElement {
        const {press} = this, say = h("output", {}), slider: HTMLInputElement = h("input", {type: "range", id: "force", min: -2, max: 1.3, step: 0.01, "aria-label": "Force of a press", oninput: () => set(10 ** Number(slider.value))});
        const set = (force: number) => {
            press.target = this.settings.force = Number(Math.max(0.01, Math.min(20, force)).toPrecision(3));
            slider.value = String(Math.log10(press.target));
            say.textContent = quantity(press.target, "N", true);
            putSettingsInLink(this.settings);
        };
        this.stage.changeForce = (factor) => set(press.target * factor);
        set(press.target);
        const shear: HTMLInputElement = h("input", {type: "checkbox", id: "shear", onchange: () => { press.hasShear = shear.checked; }});
        return h("p", {class: "bar"}, h("label", {}, "Force ", slider, " ", say), h("label", {title: "Friction of half the force against a movement"}, shear, " Friction"));
    }

    /// Movements that the page makes by itself.
    private programmes(): HTMLElement {
        const {press} = this, frequency: HTMLInputElement = h("input", {type: "number", id: "vibration", value: 100, min: 1, max: 500, "aria-label": "Frequency of the vibration in Hz"});
        const line = (): [[number, number], [number, number]] => {
            const reach = 6e-3;  // m
            return [[press.x - reach, press.y], [press.x + reach, press.y]];
        };
        const button = (text: string, id: string, play: () => void) => h("button", {type: "button", id, onclick: play}, text);
        return h("p", {class: "bar"}, button("Tap", "tap", () => press.play(tap(press.x, press.y))), button("Stroke", "stroke", () => press.play(stroke(...line()))),
            button("Vibrate", "vibrate", () => press.play(vibration(press.x, press.y, Number(frequency.value)))), h("label", {}, "at ", frequency, " Hz"));
    }

    /// Choosers of skin and indenter, sampling rate, and the sliders of the indenter.
    private showSkinControls() {
        const {catalogue, settings} = this, populations = ["none", ...catalogue.populations.map(({name}) => name)], indenters = catalogue.indenters.map(({name}) => name), rates = [1000, 2000, 5000, 10_000, 20_000];
        const restart = (change: () => void) => { change(); void this.start(); };
        const indenter = catalogue.indenters[Math.max(0, indenters.indexOf(settings.indenter))];
        const parameters = catalogue.contact.filter(({name}) => indenter.parameters.includes(name));
        const control = (one: typeof parameters[0]) => parameterControl(one, Number.parseFloat(settings.contact.get(one.name) ?? "") || one.default, (text) => {
            if (text === null) settings.contact.delete(one.name); else settings.contact.set(one.name, text);
            putSettingsInLink(settings);
            void this.session.setContact();
        });
        fill(this.skinControls, h("p", {class: "bar"},
            chooser("Skin", populations, Math.max(0, populations.indexOf(settings.population)), (k) => restart(() => { settings.population = k ? populations[k] : ""; })),
            chooser("Indenter", indenters, indenters.indexOf(indenter.name), (k) => restart(() => { settings.indenter = indenters[k]; settings.contact.clear(); })),
            chooser("Samples per second", rates.map(String), rates.indexOf(settings.rate), (k) => restart(() => { settings.rate = rates[k]; }))),
            h("details", {}, h("summary", {}, "Indenter and contact"), h("div", {class: "parameters"}, ...parameters.map(control))));
    }

    async start() {
        this.say("");
        if (!await this.session.start()) return;
        putSettingsInLink(this.settings);
        if (this.session.warnings.length) this.say(this.session.warnings.join(" "));
        this.showSkinControls();
        this.stage.renew();
        this.charts.renew();
        this.rows.renew();
    }

    /// Simulates and draws, once per screen frame.
    run() {
        requestAnimationFrame((now) => {
            this.run();
            const {session} = this;
            session.frame(now / 1000);
            this.stage.draw();
            this.charts.follow();
            ++this.frames;
            if (now - this.lastUpdate < 1000 / UPDATES) return;
            const seconds = (now - this.lastUpdate) / 1000;
            this.status.textContent = `${session.time.toFixed(1)} s, ${Math.round(this.frames / seconds)} frames/s, engine ${session.speed < 10 ? session.speed.toFixed(1) : Math.round(session.speed)} times real time`;
            [this.frames, this.lastUpdate] = [0, now];
            this.rows.update();
        });
    }

    /// For tests.
    get handles() { return {session: this.session, press: this.press, charts: this.charts, stage: this.stage}; }
}

/// The force of the session as a recording.
function forceText({force}: Session): string {
    const {T, samples} = force.clock, first = Math.max(0, samples - Math.round(HISTORY / T)), rows: [number, number | null][] = [];
    for (let k = first; k < samples; ++k) rows.push([Number((k * T).toPrecision(12)), force.range(k, k + 1)[0]]);
    return csvText(["time_s", "force_N"], rows);
}

/// Starts the page with an engine. `head`: its answer to the request `catalogue`, if it is known already.
export async function showLivePage(engine: Engine, head?: object) {
    const waiting = h("p", {class: "note", id: "loading"}, "The engine starts …");
    document.body.append(waiting);
    try {
        const catalogue = catalogueOf(head || (await engine.request({request: "catalogue"})).head), settings = settingsOfLink(catalogue);
        waiting.remove();
        const page = new LivePage(engine, catalogue, settings || defaultSettings(catalogue));
        await page.start();
        if (!settings) page.say("The link of this page is damaged, so the page starts with its defaults.");
        (window as any).corpuscle = page.handles;
        page.run();
    } catch (error) {
        fill(waiting, (error as Error).message);
    }
}
