// The live page: a skin to press, the afferents that feel it, and what their nerves and chips do.

import type {NumberArray} from "../base/arrays";
import {onAppearanceChange} from "../base/colours";
import {append, chooser, download, fill, h} from "../base/dom";
import {currentAddress, onLinkChange} from "../base/link";
import {quantity} from "../base/text";
import {csvText} from "../plot/panel";
import {connectKeys} from "../plot/pointer";
import {copy, folded} from "../shell";
import {Catalogue, catalogueOf} from "./catalogue";
import {Charts} from "./charts";
import type {Engine} from "./engine";
import {Press, stroke, tap, vibration} from "./press";
import {Recording} from "./recording";
import {Rows} from "./rows";
import {Session} from "./session";
import {MAX_FORCE, MIN_FORCE, SettingQueue, copyOf, defaultSettings, putSettingsInLink, settingsOfLink} from "./settings";
import {parameterControl} from "./sliders";
import {Sound} from "./sound";
import {SkinView} from "./skin-view";

const UPDATES = 8;  // of the numbers in the rows, per second
const MAX_FREQUENCY = 500;  // of a vibration, Hz

class LivePage {
    private message = h("p", {class: "notes", role: "alert", id: "message", hidden: true});
    private status = h("span", {class: "readout", id: "status"});
    private pause = h("button", {type: "button", id: "pause", title: "Stop and go on", onclick: () => { this.session.isPaused = !this.session.isPaused; }}, "Pause");
    private press = new Press();
    private session: Session;
    private skinView: SkinView;
    private charts: Charts;
    private rows: Rows;
    private sound = new Sound();
    private nwb = h("button", {type: "button", id: "save-nwb", hidden: true, title: "Save the spikes since the start and the force of the last minute as NWB", onclick: () => void this.saveNwb()}, "Save NWB");
    private skinControls = h("div", {class: "skin-controls"});
    private chartHost = h("div", {class: "charts"});
    private showForce = () => {};  // on its control; set by forceControl()
    private shear: HTMLInputElement = h("input", {type: "checkbox", id: "shear"});
    private recording: Recording | null = null;  // when its section has been opened
    private frames = 0;
    private lastUpdate = 0;

    constructor(engine: Engine, private catalogue: Catalogue) {
        const settings = defaultSettings(catalogue);
        this.session = new Session(engine, catalogue, settings, this.press, (text) => this.say(text));
        this.session.newSpikes = (times) => this.sound.play(times, this.session.time);
        this.skinView = new SkinView(this.session, this.press);
        this.charts = new Charts(this.session, this.chartHost);
        this.rows = new Rows(this.session, this.charts, (change) => void this.restart(change), () => putSettingsInLink(settings));
        this.build(engine);
        engine.whenEnded((reason) => {
            this.session.isPaused = true;
            this.say(reason);
        });
    }

    private get settings() { return this.session.settings; }

    /// Shows a message; "" hides it.
    say(text: string) {
        this.message.textContent = text;
        this.message.hidden = !text;
    }

    private build(engine: Engine) {
        const main = h("main", {class: "live"}, h("section", {class: "press"}, this.skinView.root, this.forceControl(), h("div", {class: "controls"}, this.programmes(), this.skinControls)),
            h("section", {class: "responses"}, this.chartHost, this.rows.root));
        append(document.body, h("header", {}, h("h1", {}, "Press a skin"), h("span", {class: "program"}, `corpuscle ${this.catalogue.version}, computed in ${engine.place}`)), this.toolbar(), this.message, main);
        folded(document.body, "recordings", "Replay a recording", "", "", (host) => host.append((this.recording = new Recording(this.session)).root));
        connectKeys(this.charts.view);
        onAppearanceChange(() => { this.skinView.redraw(); this.charts.view.request(); });
    }

    private toolbar(): HTMLElement {
        const {session} = this, button = (text: string, id: string, title: string, act: (button: HTMLButtonElement) => void) => {
            const node: HTMLButtonElement = h("button", {type: "button", id, title, onclick: () => act(node)}, text);
            return node;
        };
        return h("div", {class: "toolbar", role: "toolbar", "aria-label": "simulation"},
            this.pause,
            button("Restart", "restart", "Start again from rest", () => void this.start()),
            button("Follow", "follow", "Show the present again", () => this.charts.followAgain()),
            button("Sound off", "sound", "Hear the spikes of the rows", (node) => void this.sound.toggle().then((on) => { node.textContent = on ? "Sound on" : "Sound off"; })),
            button("Copy link", "copy-link", "Copy a link to this page with its settings", (node) => this.copyLink(node)),
            button("Save spikes", "save", "Save the spikes of this session since its start as CSV", () => void this.save({format: "csv"})),
            this.nwb,
            button("Save force", "save-force", "Save the force of the last minute as a recording, which corpuscle respond reads", () => download("force.csv", forceText(session))),
            this.status);
    }

    /// The click may also have ended the typing of a value, which the engine has to accept first.
    private copyLink(button: HTMLButtonElement) {
        if (this.session.isChanging) requestAnimationFrame(() => this.copyLink(button));
        else {
            putSettingsInLink(this.settings);  // it may still be a link that was refused
            copy(currentAddress(), button);
        }
    }

    private async saveNwb() {
        const {first, values} = this.session.recentForce();
        await this.save({format: "nwb", force_from: first}, {force: values});
    }

    private async save(how: object, sent: Record<string, NumberArray> = {}) {
        this.say("");
        try {
            const {head, arrays} = await this.session.engine.request({request: "save", ...how}, sent);
            download(head.name, new Blob([arrays.file]));
            if (this.session.isSilent) this.say(`Nothing has fired since the start of this session, so ${head.name} has no spikes.${document.getElementById("save-replay") ? " The replay below has a button of its own: Save spikes of this replay." : ""}`);
            if (head.dropped) this.say(`${head.name} lacks the first ${head.dropped} spikes, which the engine no longer has.`);
        } catch (error) {
            this.say((error as Error).message);
        }
    }

    private forceControl(): HTMLElement {
        const {press} = this, output = h("output", {}), slider: HTMLInputElement = h("input", {type: "range", id: "force", min: Math.log10(MIN_FORCE), max: Math.log10(MAX_FORCE), step: 0.01, "aria-label": "Force of a press", oninput: () => set(10 ** Number(slider.value))});
        this.showForce = () => {
            press.target = this.settings.force;
            slider.value = String(Math.log10(press.target));
            output.textContent = quantity(press.target, "N", true);
        };
        const set = (force: number) => {
            this.settings.force = Number(Math.max(MIN_FORCE, Math.min(MAX_FORCE, force)).toPrecision(3));
            this.showForce();
            putSettingsInLink(this.settings);
        };
        this.skinView.changeForce = (factor) => set(press.target * factor);
        const shear = this.shear;
        shear.onchange = () => { press.hasShear = shear.checked; };
        return h("p", {class: "bar"}, h("label", {}, "Force ", slider, " ", output), h("label", {title: "The contact pulls the skin along with its movement, with half its force, unless Indenter and contact gives it a tilt or friction"}, shear, " Friction"));
    }

    /// Movements that the page makes by itself.
    private programmes(): HTMLElement {
        const {press} = this, frequency: HTMLInputElement = h("input", {type: "number", id: "vibration", value: 100, min: 1, max: MAX_FREQUENCY, "aria-label": "Frequency of the vibration in Hz"});
        const line = (): [[number, number], [number, number]] => {
            const reach = 6e-3;  // m
            return [[press.x - reach, press.y], [press.x + reach, press.y]];
        };
        const frequencyInRange = () => {  // typed values may be outside
            const highest = Math.min(MAX_FREQUENCY, 0.45 * this.settings.rate), hertz = Math.max(1, Math.min(highest, Number(frequency.value)));
            frequency.value = String(hertz);
            return hertz;
        };
        const button = (text: string, id: string, play: () => void) => h("button", {type: "button", id, onclick: play}, text);
        return h("p", {class: "bar"}, button("Tap", "tap", () => press.play(tap(press.x, press.y))), button("Stroke", "stroke", () => press.play(stroke(...line()))),
            button("Vibrate", "vibrate", () => press.play(vibration(press.x, press.y, frequencyInRange()))), h("label", {}, "at ", frequency, " Hz"));
    }

    /// Choosers of skin and indenter, sampling rate, and the sliders of the indenter.
    private showSkinControls() {
        const {catalogue, settings} = this, populations = ["none", ...catalogue.populations.map(({name}) => name)], indenters = catalogue.indenters.map(({name}) => name), rates = [...new Set([1000, 2000, 5000, 10_000, 20_000, settings.rate])].sort((a, b) => a - b);
        const restart = (change: () => void) => void this.restart(change), isOpen = this.skinControls.querySelector("details")?.open || false;
        const values = this.session.contactValues, parameters = catalogue.contact.filter(({name}) => values.has(name));
        const queue = new SettingQueue(settings.contact, async () => {
            const isAccepted = await this.session.setContact();
            if (isAccepted) putSettingsInLink(settings);
            return isAccepted;
        });
        const change = async (name: string, text: string | null) => {
            const endsTilt = name === "tilt" && !Number.parseFloat(text || "0") && settings.contact.has("azimuth");
            if (endsTilt) await queue.change("azimuth", null);  // the direction of the tilt; the engine refuses it alone
            const isAccepted = await queue.change(name, text);
            if (endsTilt) this.showSkinControls();
            return isAccepted;
        };
        const control = (one: typeof parameters[0]) => parameterControl(one, values.get(one.name)!, (text) => change(one.name, text));
        fill(this.skinControls, h("p", {class: "bar"},
            chooser("Skin", populations, Math.max(0, populations.indexOf(settings.population)), (k) => restart(() => { settings.population = k ? populations[k] : ""; })),
            chooser("Indenter", indenters, indenters.indexOf(settings.indenter), (k) => restart(() => { settings.indenter = indenters[k]; settings.contact.clear(); })),
            chooser("Samples per second", rates.map(String), rates.indexOf(settings.rate), (k) => restart(() => { settings.rate = rates[k]; }))),
            h("details", {open: isOpen}, h("summary", {}, "Indenter and contact"), h("div", {class: "parameters"}, ...parameters.map(control))));
    }

    /// Starts the simulation with changed settings. If the engine refuses them, they and the simulation stay as they were.
    private async restart(change: () => void) {
        const before = copyOf(this.settings);
        change();
        if (await this.start()) return;
        Object.assign(this.settings, before);
        this.showSkinControls();
        this.rows.renew();
    }

    /// Starts the simulation, and puts the settings into the link, unless it keeps the link of the user. Returns false, after a message, if the engine refuses the settings.
    async start(keepsLink = false): Promise<boolean> {
        this.say("");
        if (!await this.session.start()) return false;
        if (!keepsLink) putSettingsInLink(this.settings);
        this.showForce();
        if (this.session.warnings.length) this.say(this.session.warnings.join("; "));
        this.nwb.hidden = !this.session.formats.includes("nwb");
        this.showSkinControls();
        this.skinView.renew();
        this.charts.renew();
        this.rows.renew();
        return true;
    }

    /// Starts with the settings of the link, or with the defaults if it is damaged or the engine refuses it. Such a link stays in the address bar, where
    /// the user can correct it, until a setting changes or the user restarts.
    async openLink() {
        const settings = settingsOfLink(this.catalogue);
        let reason = "";
        if (typeof settings === "string") reason = `is damaged${settings ? `: its part ${settings.slice(0, 40)} cannot be read` : ""}`;
        else {
            Object.assign(this.settings, settings);
            if (!await this.start()) reason = `is refused (${this.message.textContent})`;
        }
        if (!reason) return;
        Object.assign(this.settings, defaultSettings(this.catalogue));
        if (await this.start(true)) this.say(`The link of this page ${reason}, so the page starts with its defaults.`);
    }

    /// Simulates and draws, once per screen frame.
    run() {
        requestAnimationFrame((now) => {
            this.run();
            const {session} = this;
            session.frame(now / 1000);
            this.skinView.draw();
            this.charts.follow();
            ++this.frames;
            if (now - this.lastUpdate < 1000 / UPDATES) return;
            const seconds = (now - this.lastUpdate) / 1000;
            this.status.textContent = `${session.time.toFixed(1)} s, ${Math.round(this.frames / seconds)} frames/s, engine ${session.speed < 10 ? session.speed.toFixed(1) : Math.round(session.speed)} times real time`;
            [this.frames, this.lastUpdate] = [0, now];
            this.pause.textContent = session.isPaused ? "Go on" : "Pause";
            this.shear.disabled = session.hasOwnShear;
            this.rows.update();
            this.recording?.update();
        });
    }

    /// For tests.
    get handles() { return {session: this.session, press: this.press, charts: this.charts, skinView: this.skinView}; }
}

/// The force of the session as a recording.
function forceText(session: Session): string {
    const {first, values} = session.recentForce(), {T} = session.force.clock;
    return csvText(["time_s", "force_N"], Array.from(values, (force, k) => [Number(((first + k) * T).toPrecision(12)), force]));
}

/// Starts the page with an engine. `head`: its answer to the request `catalogue`, if it is known already.
export async function showLivePage(engine: Engine, head?: object) {
    const waiting = h("p", {class: "note", id: "loading"}, "The engine starts …");
    document.body.append(waiting);
    try {
        const catalogue = catalogueOf(head || (await engine.request({request: "catalogue"})).head);
        waiting.remove();
        const page = new LivePage(engine, catalogue);
        await page.openLink();
        onLinkChange(() => void page.openLink());
        (window as any).corpuscle = page.handles;
        page.run();
    } catch (error) {
        fill(waiting, (error as Error).message);
    }
}
