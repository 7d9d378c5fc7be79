// The list of afferents that feel the whole force: which they are, how they fire now, and the controls of their parameters.

import {append, fill, h} from "../base/dom";
import {quantity} from "../base/text";
import type {Charts} from "./charts";
import {Chip} from "./chip";
import type {Setting} from "./catalogue";
import type {Session} from "./session";
import {MAX_ROWS, RowSettings, SettingQueue} from "./settings";
import {parameterControl, settingControl} from "./sliders";

const RATE_WINDOW = 0.25;  // s

export class Rows {
    readonly root = h("div", {class: "rows", id: "rows"});
    private readouts: HTMLElement[] = [];
    private chips: (Chip | null)[] = [];
    private open = new Set<number>();  // rows whose details are shown
    private closers: (() => void)[] = [];

    /// `restart`: changes the settings and starts the simulation. `changed`: called when a setting of a running row has changed.
    constructor(private session: Session, private charts: Charts, private restart: (change: () => void) => void, private changed: () => void) {}

    /// Builds the list anew, after a start.
    renew() {
        const {session} = this;
        this.closers.splice(0).forEach((close) => close());
        this.readouts = session.rows.map(() => h("span", {class: "readout"}));
        this.chips = session.rows.map(() => null);
        fill(this.root, ...session.rows.map((_, k) => this.card(k)), this.adder());
    }

    /// Shows rates and powers of now; called a few times a second.
    update() {
        const {session} = this;
        session.rows.forEach(({train, power, error, outside, info}, k) => {
            const text = error || `${quantity(train.rate(session.time - info.delay, RATE_WINDOW), "Hz", true)}, ${train.count} spikes${power ? `, ${quantity(power, "W", true)}` : ""}${outside ? `. ${outside}` : ""}`;
            if (this.readouts[k].textContent !== text) this.readouts[k].textContent = text;
            if (this.chips[k] && this.open.has(k)) void this.chips[k]!.update();
        });
    }

    private adder(): HTMLElement {
        const {afferents} = this.session.catalogue, {rows} = this.session.settings;
        const select: HTMLSelectElement = h("select", {id: "add-row", "aria-label": "Add an afferent", disabled: rows.length >= MAX_ROWS, onchange: () => this.add(afferents[select.selectedIndex - 1].name)},
            h("option", {}, "Add an afferent …"), ...afferents.map(({name, composition}) => h("option", {}, `${name}  (${composition})`)));
        return h("div", {class: "row-card"}, select);
    }

    private add(afferent: string) {
        this.restart(() => this.session.settings.rows.push({afferent, set: new Map()}));
    }

    /// `row`: not its number, which another removal may have changed.
    private remove(row: RowSettings) {
        this.open.clear();
        this.restart(() => { this.session.settings.rows = this.session.settings.rows.filter((one) => one !== row); });
    }

    private card(k: number): HTMLElement {
        const {info} = this.session.rows[k], own = this.session.settings.rows[k], content = h("div"), details: HTMLDetailsElement = h("details", {open: this.open.has(k)},
            h("summary", {}, h("span", {class: "chip", style: `background: ${this.session.rows[k].colour}`}), h("b", {}, info.name), " ", this.readouts[k]), content);
        details.addEventListener("toggle", () => {
            if (details.open) this.open.add(k);
            else this.open.delete(k);
            if (details.open && !content.firstChild) this.showDetails(k, content);
        });
        if (details.open) this.showDetails(k, content);
        return h("div", {class: "row-card", "data-row": info.name}, details, h("button", {type: "button", class: "remove", title: "Remove", "aria-label": `Remove ${info.name}`, onclick: (event: MouseEvent) => { if (event.detail < 2) this.remove(own); }}, "×"));
    }

    private showDetails(k: number, host: HTMLElement) {
        const row = this.session.rows[k], {set} = this.session.settings.rows[k], queue = new SettingQueue(set, () => this.send(k)), described = this.session.catalogue.afferents.find(({name}) => name === row.info.name);
        append(host, h("p", {class: "note"}, described ? `${described.description} (${described.composition})` : row.info.composition));
        const probes = h("div", {class: "probes"});
        host.append(probes);
        this.closers.push(this.charts.showProbes(row, probes));
        if (row.info.is_circuit) {
            const chip = this.chips[k] = new Chip(this.session, k, host);
            this.closers.push(() => chip.close());
            void chip.update();
        }
        append(host, h("h3", {}, "Parameters"), h("div", {class: "parameters"}, ...row.info.parameters.map((one) => parameterControl(one, one.value ?? one.default, (text) => queue.change(one.name, text)))));
        if (row.info.is_circuit) void this.showSettings(k, queue, host.appendChild(h("div")));
    }

    /// Supply, temperature, corner and sizes of a circuit.
    private async showSettings(k: number, queue: SettingQueue, host: HTMLElement) {
        const {afferent, set} = this.session.settings.rows[k];
        let all: Setting[];
        try {
            all = (await this.session.engine.request({request: "settable", afferent})).head.settable;
        } catch (error) {
            fill(host, h("p", {class: "note"}, (error as Error).message));
            return;
        }
        const control = (one: Setting) => settingControl(one, set.get(one.name), (text) => queue.change(one.name, text));
        const blocks = [...new Set(all.map(({block}) => block || ""))].filter(Boolean);
        append(host, h("h3", {}, "Supply, temperature, corner"), h("div", {class: "parameters"}, ...all.filter(({block}) => !block).map(control)), h("h3", {}, "Sizes of the devices"));
        for (const block of blocks) {
            const own = all.filter((one) => one.block === block), content = h("div", {class: "parameters"}), node: HTMLDetailsElement = h("details", {}, h("summary", {}, `${block} (${own.length})`), content);
            node.addEventListener("toggle", () => { if (node.open && !content.firstChild) append(content, ...own.map(control)); });
            host.append(node);
        }
    }

    private async send(k: number): Promise<boolean> {
        const isAccepted = await this.session.setRow(k);
        if (isAccepted) this.changed();
        return isAccepted;
    }
}
