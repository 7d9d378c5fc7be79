// The part of the skin that all maps show, and the chosen mark.

import {onAppearanceChange} from "../base/colours";
import {h, pixelRatio} from "../base/dom";
import {Box, SkinGeometry, boxOf, grown, joined} from "./geometry";
import {Levels, Surface} from "./surface";
import type {SkinMap} from "./skin-map";

/// Several maps of one skin: they show the same box and the same force, and the same mark is chosen on all of them. Call request() when activity
/// has changed, and forceChanged() when force has.
export class SkinScene {
    maps: SkinMap[] = [];
    chosen: number | null = null;  // index of a mark
    width = 300;                   // of a map, CSS pixels
    height = 300;
    scale = 1;                     // pixels per m
    distance = Infinity;           // between neighbouring marks on the densest map, m
    readonly all: Box;             // of the complete skin
    private box: Box;
    private cx = 0;
    private cy = 0;
    private isWaiting = false;
    readonly surface: Surface;
    /// Must be called when the maps are removed from the page.
    readonly remove: () => void;

    /// `force`: the force on the sites.
    constructor(readonly geometry: SkinGeometry, force: Levels = () => {}) {
        const sites = boxOf(geometry.sites);
        const contents = [boxOf(geometry.marks), ...geometry.outline.map((one) => boxOf(one))].reduce(joined, grown(sites, geometry.side / 2));
        this.all = this.box = grown(contents, 0.03 * Math.max(contents[2] - contents[0], contents[3] - contents[1]));
        this.surface = new Surface(this, force);
        this.remove = onAppearanceChange(() => this.renew());
    }

    /// The radius of an active mark, pixels: equal on all maps.
    get dotRadius() { return Math.max(2.2, Math.min(8, 0.36 * this.distance * this.scale)); }
    get aspect() { return (this.all[2] - this.all[0]) / (this.all[3] - this.all[1]); }
    get isComplete() { return this.box === this.all; }

    /// Sets the size of all maps, in CSS pixels.
    resize(width: number, height: number) {
        [this.width, this.height] = [Math.max(40, Math.floor(width)), Math.max(40, Math.floor(height))];
        this.renew();
    }

    /// Discards what depends on size, box and theme.
    renew() {
        const [x0, y0, x1, y1] = this.box;
        this.scale = Math.min(this.width / (x1 - x0), this.height / (y1 - y0));
        [this.cx, this.cy] = [(x0 + x1) / 2, (y0 + y1) / 2];
        this.surface.renew();
        this.maps.forEach((map) => map.renew());
        this.request();
    }

    x(metres: number) { return this.width / 2 + (metres - this.cx) * this.scale; }
    y(metres: number) { return this.height / 2 - (metres - this.cy) * this.scale; }

    /// The point of the skin, in m, at pixels of a map.
    placeAt(x: number, y: number): [number, number] { return [this.cx + (x - this.width / 2) / this.scale, this.cy - (y - this.height / 2) / this.scale]; }

    show(box: Box) {
        this.box = box;
        this.renew();
    }

    /// Multiplies the visible length by `factor`; the point (x, y) of a map keeps its place. Shows the complete skin rather than much more than it.
    zoom(factor: number, x = this.width / 2, y = this.height / 2) {
        const [px, py] = this.placeAt(x, y);
        const w = this.width / this.scale * factor, height = this.height / this.scale * factor;
        const cx = px - (px - this.cx) * factor, cy = py - (py - this.cy) * factor, [x0, y0, x1, y1] = this.all;
        if (w > 1.2 * (x1 - x0) && height > 1.2 * (y1 - y0)) this.show(this.all);
        else if (w > 1e-3) this.show([cx - w / 2, cy - height / 2, cx + w / 2, cy + height / 2]);
    }

    /// Moves the skin by pixels.
    pan(dx: number, dy: number) {
        const x = -dx / this.scale, y = dy / this.scale, [x0, y0, x1, y1] = this.box;
        this.show([x0 + x, y0 + y, x1 + x, y1 + y]);
    }

    choose(mark: number | null) {
        this.chosen = mark;
        this.request();
    }

    forceChanged() {
        this.surface.forceChanged();
        this.request();
    }

    /// Draws all maps at the next frame of the screen.
    request() {
        if (!this.isWaiting) requestAnimationFrame(() => this.draw());
        this.isWaiting = true;
    }

    draw() {
        this.isWaiting = false;
        this.maps.forEach((map) => map.draw());
    }

    /// A canvas as large as a map, and its pen.
    layer(): [HTMLCanvasElement, CanvasRenderingContext2D] {
        const ratio = pixelRatio(), canvas = h("canvas", {width: Math.round(this.width * ratio), height: Math.round(this.height * ratio)}), pen = canvas.getContext("2d")!;
        pen.scale(ratio, ratio);
        return [canvas, pen];
    }
}
