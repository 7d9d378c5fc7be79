// The maps of the page of a skin: one for each class, with force and activity at the time of the cursor.

import {mixed} from "../base/colours";
import {Child, chooser, fill, h, isNarrow} from "../base/dom";
import {fixedText, quantity} from "../base/text";
import {csvText} from "../plot/panel";
import type {View} from "../plot/view";
import {section} from "../shell";
import {FirstSpikes, Mode, firstSpikesOf, modesOf} from "../skin/activity";
import type {Box} from "../skin/geometry";
import type {SkinRecording} from "../skin/recording";
import {regionsOf} from "../skin/regions";
import {colourScale} from "../skin/scale";
import {SkinScene} from "../skin/scene";
import {SkinMap} from "../skin/skin-map";
import {rateRamp, timeRamp} from "../skin/stamps";
import {forceOpacity} from "../skin/surface";

const GAP = 12;  // between maps, pixels

export class SkinMaps {
    readonly scene: SkinScene;
    readonly modes: Mode[];
    mode: Mode;
    time: number;
    private maps: SkinMap[] = [];
    private scales: HTMLElement[] = [];
    private unit = h("p", {class: "readout unit-about", id: "unit", role: "status"});
    private when = h("span", {class: "when readout strong"});  // on paper, where there is no player
    private row = h("div", {class: "skin-row"});
    readonly regions: [string, Box][];
    region = 0;
    private regionSelect: HTMLSelectElement;
    private modeSelect: HTMLSelectElement;
    private firsts: FirstSpikes | null;

    constructor(host: Element, private skin: SkinRecording, view: View, private changed: () => void) {
        const {force} = skin, sitesPerMark = skin.data.over.sites_per_mark;
        this.scene = new SkinScene(skin.geometry, (draw) => {
            const frame = skin.frameAt(this.time);
            if (this.mode.isOverAll || frame >= force.count) return;
            force.each(frame, (place, level) => { for (let s = place * sitesPerMark; s < Math.min((place + 1) * sitesPerMark, skin.geometry.sites.length / 2); ++s) draw(s, level / 254); });
        });
        [this.modes, this.time, this.regions, this.firsts] = [modesOf(skin), skin.clock.t0, regionsOf(skin, this.scene.all), firstSpikesOf(skin)];
        this.mode = this.modes[0];
        const about = skin.data.over.afferents_per_mark > 1 ? `Each mark is a group of ${skin.data.over.afferents_per_mark} neighbouring afferents` : "Each mark is an afferent";
        const node = section(host, "maps", "Skin maps", about), show = chooser("Show", this.modes.map(({label}) => label), 0, (k) => this.setMode(k));
        const zoom = chooser("Region", this.regions.map(([name]) => name), 0, (k) => this.setRegion(k));
        [this.modeSelect, this.regionSelect] = [show.querySelector("select")!, zoom.querySelector("select")!];
        [this.modeSelect.id, this.regionSelect.id] = ["mode", "region"];
        node.append(h("div", {class: "bar", role: "group", "aria-label": "maps"}, show, zoom,
            h("span", {class: "buttons"}, this.button("−", "Zoom out of the maps", 1.5), this.button("+", "Zoom into the maps", 1 / 1.5)), this.forceKey(), this.when), this.row, this.unit);
        skin.classes.forEach((_, k) => this.addMap(k));
        new ResizeObserver(() => this.layOut()).observe(this.row);
        this.layOut();
        addEventListener("beforeprint", () => { this.layOut(); this.scene.draw(); });
        addEventListener("afterprint", () => this.layOut());
        view.onCursor(() => view.cursor !== null && this.setTime(view.cursor));
        this.showScales();
    }

    /// The number of active marks of each class.
    get active() { return Object.fromEntries(this.maps.map((map, k) => [this.skin.classes[k].name, map.active])); }

    private button(text: string, name: string, factor: number) { return h("button", {type: "button", title: name, "aria-label": name, onclick: () => this.scene.zoom(factor)}, text); }

    private addMap(k: number) {
        const {skin} = this, {name, afferents, colour} = skin.classes[k];
        const count = h("span", {class: "readout"}), scale = h("span");
        const title: Child[] = [h("span", {class: "panel-title"}, h("span", {class: "chip", style: `background: ${colour}`}), name), h("span", {class: "unit"}, `${afferents} afferents`), count, scale];
        const drawn = ({canvas, active, from, to}: SkinMap) => {
            count.textContent = `${active} active`;
            canvas.setAttribute("aria-label", `${name}: ${active} of ${to - from} active, ${this.mode.isOverAll ? "over the recording" : `at ${fixedText(this.time, 1e-3)}`}`);
        };
        this.maps.push(new SkinMap(this.scene, {host: this.row, name, title, about: `activity of ${name} on the skin`, classes: [k], activity: (draw) => this.mode.activity(this.time)(draw), hasRings: true,
                                                describe: (mark) => this.describe(mark), pick: (mark) => this.choose(mark), csv: (map) => this.csv(map), drawn}));
        this.scales.push(scale);
    }

    /// Adds maps of the first spikes, of the same size.
    addFirstSpikes(host: Element) {
        const {skin, firsts} = this, fired = skin.classes.reduce((sum, {active}) => sum + active, 0), all = skin.data.summary.skin.afferents;
        const node = section(host, "firsts", "First spikes", `${fired} of ${all} afferents fired`);
        if (!firsts) return node;
        const row = h("div", {class: "skin-row"});
        skin.classes.forEach(({name, colour, active}, k) => new SkinMap(this.scene, {
            host: row, name: `first ${name}`, about: `first spike of each ${name} afferent`, classes: [k], activity: firsts.activity, ramp: timeRamp, hasForce: false, describe: (mark) => this.describe(mark),
            pick: (mark) => this.choose(mark), title: [h("span", {class: "panel-title"}, h("span", {class: "chip", style: `background: ${colour}`}), name), h("span", {class: "readout"}, `${active} fired`)]}));
        node.append(h("div", {class: "bar"}, colourScale(timeRamp(), firsts.scale, "first spike at ")), row);
        this.scene.request();
        return node;
    }

    setMode(k: number) {
        this.mode = this.modes[k];
        this.modeSelect.selectedIndex = k;
        this.showScales();
        this.scene.forceChanged();
        this.changed();
    }

    setRegion(k: number) {
        this.region = k;
        this.regionSelect.selectedIndex = k;
        this.scene.show(this.regions[k][1]);
        this.changed();
    }

    private setTime(t: number) {
        if (t === this.time) return;
        this.time = t;
        this.when.textContent = `t = ${fixedText(t, 1e-4)}`;
        this.scene.forceChanged();
        this.showMark();
    }

    /// Chooses a mark, which is under the pointer on a map or in a raster.
    choose(mark: number | null) {
        this.scene.choose(mark);
        this.showMark();
    }

    private showMark() { this.unit.textContent = this.scene.chosen === null ? "" : this.describe(this.scene.chosen); }

    describe(mark: number): string {
        const {skin} = this, {firstSpikes, totals, clock} = skin, frames = skin.framesOver(0.1), frame = skin.frameAt(this.time);
        const rate = skin.recent(frame, frames).counts[mark] / skin.afferentsIn(mark) / skin.lengthOver(frame, frames);
        const first = Number.isNaN(firstSpikes[mark]) ? "" : `, the first at ${fixedText(clock.t0 + firstSpikes[mark], 1e-4)}`;
        return `${skin.markName(mark)}: ${quantity(rate, "Hz", true)} in ${quantity(frames * skin.marks.width, "s", true)}, ${totals[mark]} spike${totals[mark] === 1 ? "" : "s"}${first}`;
    }

    private showScales() {
        this.skin.classes.forEach(({colour}, k) => fill(this.scales[k], colourScale(rateRamp(colour), this.mode.scale(k))));
        this.maps.forEach((map) => { map.options.hasRings = this.mode.hasRings; });
    }

    /// The scale of the force: the mean over a frame of the force on a site, or on a group of neighbours.
    private forceKey(): HTMLElement | null {
        const {over, summary} = this.skin.data, most = over.sites.max || 0, area = summary.skin.site_area_m2 * over.sites_per_mark * 1e6;
        if (!most) return null;
        const colours = [0, 0.2, 0.4, 0.6, 0.8, 1].map((level) => mixed("var(--flesh)", "var(--force)", forceOpacity(level)));
        return colourScale(colours, ["0", quantity(most / 2, "N", true), quantity(most, "N", true)], `force on ${area ? `${+area.toPrecision(3)} mm²` : "a sensor"} `);
    }

    /// All maps are as large as the width allows; on a phone, one is swiped to the next.
    layOut() {
        const width = this.row.clientWidth, count = this.maps.length, {aspect} = this.scene, isSwiped = isNarrow() && width < 520;
        if (!width) return;
        const tallest = isSwiped ? 0.56 * innerHeight : Math.max(260, Math.min(720, 0.6 * innerHeight));
        let columns = isSwiped ? 1 : count;
        const widthOf = (n: number) => (width - GAP * (n - 1)) / n;
        while (columns > 1 && widthOf(columns) < Math.min(220, 0.9 * tallest * aspect)) columns = Math.ceil(columns / 2);
        const mapWidth = isSwiped && count > 1 ? 0.88 * width : widthOf(columns);
        this.scene.resize(mapWidth, Math.min(tallest, Math.max(90, mapWidth / aspect)));
    }

    /// The active marks of a map.
    private csv(map: SkinMap): string {
        const {marks} = this.skin.geometry, rows: (string | number)[][] = [];
        this.mode.activity(this.time)((mark, level) => {
            if (mark >= map.from && mark < map.to) rows.push([this.skin.markName(mark), marks[2 * mark], marks[2 * mark + 1], level, this.skin.totals[mark]]);
        });
        return csvText(["afferent", "x_m", "y_m", "level", "spikes"], rows);
    }
}
