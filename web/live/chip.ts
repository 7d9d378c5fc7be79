// A chip under the press: its schematic, the voltages, currents and powers of its blocks now, and a Monte Carlo of fifty like it.

import {append, fill, h} from "../base/dom";
import {quantity} from "../base/text";
import {RasterPanel} from "../panels/raster-panel";
import {table} from "../panels/table";
import {View} from "../plot/view";
import {LiveTrain, appendSpikes} from "./history";
import {Session, ValidRange, rangeText} from "./session";
import {settingTexts} from "./settings";

interface Block { name: string; power: number; nodes: {name: string; voltage: number}[]; devices: {name: string; current: number}[] }

const CHIPS = 50;                           // of a Monte Carlo
const MIN_SCALE = 0.9, MAX_SCALE = 1.3;    // of a schematic; its texts are 10 units high

export class Chip {
    private summary = h("p", {class: "readout"});
    private drawing = h("div", {class: "schematic", id: "schematic", tabindex: "0", role: "group", "aria-label": "Schematic of the circuit"});
    private block = h("div", {class: "block-state"});
    private blockDrawing = h("div", {class: "schematic", tabindex: "0", role: "group", "aria-label": "Schematic of the block"});
    private monteCarlo = h("div", {class: "monte-carlo"});
    private chosen = "";
    private isAsking = false;
    private lastText = "";
    private view: View | null = null;  // of the Monte Carlo
    private isRunning = false;         // the Monte Carlo

    constructor(private session: Session, private row: number, host: HTMLElement) {
        const run: HTMLButtonElement = h("button", {type: "button", id: "run-monte-carlo", onclick: () => void this.runMonteCarlo(run)}, `Monte Carlo: ${CHIPS} chips under a press`);
        append(host, h("h3", {}, "Circuit"), this.summary, this.drawing, h("div", {class: "columns"}, this.block, this.blockDrawing), h("p", {}, run), this.monteCarlo);
        void this.showSchematic(this.drawing, "");
    }

    private get afferent() { return this.session.rows[this.row].info.name; }

    /// Draws the top level, or a block, into a host.
    private async showSchematic(host: HTMLElement, block: string) {
        const {afferent, set} = this.session.settings.rows[this.row];
        try {
            const {arrays} = await this.session.engine.request({request: "schematic", afferent, set: settingTexts(set), block});
            const parsed = new DOMParser().parseFromString(new TextDecoder().decode(arrays.svg), "image/svg+xml").documentElement;
            fill(host, Chip.sized(document.importNode(parsed, true) as unknown as SVGSVGElement));
            host.scrollTo(0, 0);
        } catch (error) {
            fill(host, h("p", {class: "note"}, (error as Error).message));
        }
        if (!block) this.connectBlocks(host);
    }

    /// A drawing fills its panel, but its texts stay legible: a large one is wider than the panel, which scrolls.
    private static sized(svg: SVGSVGElement) {
        const {width} = svg.viewBox.baseVal;
        svg.setAttribute("role", "group");  // a picture would hide its buttons from screen readers
        svg.style.width = `clamp(${MIN_SCALE * width}px, 100%, ${MAX_SCALE * width}px)`;
        return svg;
    }

    private connectBlocks(host: HTMLElement) {
        host.querySelectorAll<SVGElement>(".block[data-block]").forEach((node) => {
            const choose = () => this.choose(node.dataset.block!);
            node.setAttribute("tabindex", "0");
            node.setAttribute("role", "button");
            node.setAttribute("aria-label", `Block ${node.dataset.block}`);
            node.addEventListener("click", choose);
            node.addEventListener("keydown", (event) => { 
                if (event.key !== "Enter" && event.key !== " ") return;
                event.preventDefault();
                choose();
            });
        });
    }

    private choose(name: string) {
        this.chosen = name;
        this.lastText = "";
        this.drawing.querySelectorAll<SVGElement>(".block[data-block]").forEach((node) => node.classList.toggle("chosen", node.dataset.block === name));
        void this.showSchematic(this.blockDrawing, name);
        void this.update();
    }

    /// Shows the state of the chip at the last simulated sample.
    async update() {
        if (this.isAsking || !this.session.rows[this.row]) return;
        this.isAsking = true;
        try {
            const {head} = await this.session.engine.request({request: "operating", row: this.row});
            this.summary.textContent = head.blocks.length ? `${quantity(head.power, "W", true)} of the supplies, ${quantity(head.sensor_power, "W", true)} of it for the sensor. Choose a block.` : "";
            this.showBlock(head.blocks);
        } catch (error) {
            this.summary.textContent = (error as Error).message;
        }
        this.isAsking = false;
    }

    private showBlock(blocks: Block[]) {
        const block = blocks.find(({name}) => name === this.chosen || `x${name}` === this.chosen) || blocks[0], text = JSON.stringify(block);
        if (!block || text === this.lastText || this.block.contains(document.activeElement)) return;
        this.lastText = text;
        const values = (what: string, heading: string, unit: string, rows: [string, number][]) =>
            rows.length > 0 && table({name: `${what}s of ${block.name}`, rows, columns: [{name: what}, {name: heading, isNumber: true, show: (v) => [quantity(v as number, unit)]}]});
        fill(this.block, h("h4", {}, `${block.name}: ${quantity(block.power, "W", true)}`), values("node", "voltage (V)", "V", block.nodes.map(({name, voltage}) => [name, voltage])),
            values("device", "current (A)", "A", block.devices.map(({name, current}) => [name, current])));
    }

    /// Simulates chips that differ by mismatch, and shows their spikes as they come.
    private async runMonteCarlo(button: HTMLButtonElement) {
        const {settings} = this.session, trains = Array.from({length: CHIPS}, () => new LiveTrain()), progress = h("p", {class: "readout", role: "status"});
        const request = {request: "monte-carlo", afferent: this.afferent, set: settingTexts(settings.rows[this.row].set), chips: CHIPS, seed: settings.seed, rate: settings.rate, stimulus: "press"};
        button.disabled = this.isRunning = true;
        this.view?.remove();
        this.view = null;
        fill(this.monteCarlo, progress);
        let rows: {error?: string; outside: number[]}[] = [], ranges: ValidRange[] = [];
        try {
            const isDone = await this.session.runJob(request, {}, ({head, arrays}) => {
                if (!this.view) this.showChips(head, trains);
                appendSpikes(trains, arrays.unit, arrays.time);
                const counts = trains.map(({count}) => count);
                progress.textContent = `${head.chips_done} of ${CHIPS} chips` + (head.done ? `: ${Math.min(...counts)} to ${Math.max(...counts)} spikes` : "");
                [rows, ranges] = [head.rows || [], head.ranges || []];
                this.view!.request();
            });
            const failed = rows.filter(({error}) => error);
            if (failed.length) progress.textContent += `; ${failed.length} of them stopped: ${failed[0].error}`;
            ranges.forEach((range, k) => {
                const left = rows.filter(({outside}) => outside[k] > 0).length;
                if (left) progress.textContent += `. In ${left} of them ${rangeText(range)}`;
            });
            if (!isDone) progress.textContent += ", stopped by another simulation";
        } catch (error) {
            progress.textContent = (error as Error).message;
        }
        button.disabled = this.isRunning = false;
    }

    private showChips({rate, samples, phases = []}: any, trains: LiveTrain[]) {
        this.view = new View();
        (window as any).corpuscle.monteCarlo = trains;
        this.view.setLimits({begin: 0, end: samples / rate, smallest: 0.01});
        this.view.add(new RasterPanel({host: this.monteCarlo, name: "monte-carlo", title: [`spikes of ${CHIPS} chips of ${this.afferent}`], about: "spikes of chips that differ by mismatch", height: 320,
                                       clock: {t0: 0, T: 1 / rate, samples}, phases, isNamed: true, isBottom: true, series: [],
                                       rows: trains.map((spikes, k) => ({series: "", label: `chip ${k + 1}`, colour: "var(--series-2)", spikes}))}));
    }

    /// Must be called when the chip is removed from the page.
    close() {
        if (this.isRunning) this.session.cancelJob();
        this.view?.remove();
    }
}
