// A map of the skin with the afferents of some classes as marks. Force and activity may change at every frame of the screen: only the marks that
// are active are drawn again, above a layer with the skin and all idle marks.
//
//     const scene = new SkinScene(geometry, (draw) => { for (const [site, newtons] of force) draw(site, newtons / most); });
//     new SkinMap(scene, {host, name: "sa1", about: "activity of sa1", classes: [0], activity: (draw) => { for (const [mark, level] of active) draw(mark, level); }});
//     scene.resize(width, height);  // pixels of each map
//     scene.forceChanged();         // when force has changed; scene.request() when only activity has
//
// A page that presses the skin with the pointer sets hasPointer to false and asks scene.placeAt(x, y) for the point of the skin. A map may have
// several classes. Its style sheet is skin-map.css.

import {mixed, resolved} from "../base/colours";
import {Child, h, pixelRatio} from "../base/dom";
import {Pen, SvgPen} from "../plot/pen";
import {saveMenu} from "../plot/save-menu";
import {DotLayer} from "./dot-layer";
import {Places, fanned, spacing} from "./geometry";
import {connectMapPointer} from "./map-pointer";
import {circle, disc, fadingRing} from "./marks";
import type {SkinScene} from "./scene";
import {DotStamps} from "./stamps";
import type {Levels} from "./surface";

export interface SkinMapOptions {
    host: Element;
    name: string;       ///< for files and tests
    about: string;      ///< for screen readers
    title?: Child[];
    classes: number[];  ///< of the geometry, adjacent and ascending
    activity: Levels;   ///< marks of other classes are ignored
    /// The colours of increasing levels, as CSS; by default tints of the colour of the class.
    ramp?: (colour: string) => string[];
    hasForce?: boolean;                   ///< true unless given
    hasRings?: boolean;                   ///< a ring grows around a mark of a sparse class while its level falls
    describe?: (mark: number) => string;  ///< of the mark under the pointer
    pick?: (mark: number | null) => void; ///< called when the pointer moves to another mark, or to none
    hasPointer?: boolean;                 ///< true unless given: pointer and keys pan and zoom, and name marks
    csv?: (map: SkinMap) => string;
    drawn?: (map: SkinMap) => void;       ///< called after each drawing
}

export class SkinMap {
    readonly root: HTMLElement;
    readonly canvas = h("canvas", {tabindex: 0, role: "img"});
    readonly caption: HTMLElement;
    readonly from: number;  // the first mark
    readonly to: number;    // after the last mark
    readonly tip = h("div", {class: "tip", role: "status"});
    active = 0;             // number of marks that the last drawing showed as active
    private idle: HTMLCanvasElement | null = null;
    private dots: DotLayer | null = null;
    private stamps: DotStamps[] = [];
    private places: Places;
    private distance: number;  // between neighbours, m

    constructor(readonly scene: SkinScene, readonly options: SkinMapOptions) {
        const {marks} = scene.geometry;
        [this.from, this.to] = [this.classes[0].first, this.classes[this.classes.length - 1].end];
        this.places = fanned(marks.subarray(2 * this.from, 2 * this.to));
        this.distance = spacing(this.places);
        this.caption = h("figcaption", {}, ...(options.title || [options.name]));
        this.canvas.setAttribute("aria-label", options.about);
        this.root = h("figure", {class: "skin-map", "data-map": options.name}, this.caption, saveMenu(options.name, this.canvas, () => this.svg(), options.csv && (() => options.csv!(this))),
            h("div", {class: "skin-canvas"}, this.canvas, this.tip));
        options.host.append(this.root);
        scene.maps.push(this);
        scene.distance = Math.min(scene.distance, this.distance);
        if (options.hasPointer !== false) connectMapPointer(this);
    }

    get classes() { return this.options.classes.map((c) => this.scene.geometry.classes[c]); }

    /// Discards what depends on size, box and theme.
    renew() {
        this.idle = this.dots = null;
        this.stamps = [];
    }

    /// The place of a mark in the map, CSS pixels.
    place(mark: number): [number, number] {
        const k = 2 * (mark - this.from);
        return [this.scene.x(this.places[k]), this.scene.y(this.places[k + 1])];
    }

    draw() {
        const {scene, canvas} = this, ratio = pixelRatio(), width = Math.round(scene.width * ratio), height = Math.round(scene.height * ratio), pen = canvas.getContext("2d")!;
        if (canvas.width !== width || canvas.height !== height) {
            [canvas.width, canvas.height] = [width, height];
            [canvas.style.width, canvas.style.height, this.root.style.width] = [`${scene.width}px`, `${scene.height}px`, `${scene.width}px`];
        }
        pen.setTransform(ratio, 0, 0, ratio, 0, 0);
        pen.clearRect(0, 0, scene.width, scene.height);
        pen.drawImage(scene.surface.groundLayer(), 0, 0, scene.width, scene.height);
        if (this.options.hasForce !== false) scene.surface.paintForce(pen);
        pen.drawImage(this.idleLayer(), 0, 0, scene.width, scene.height);
        this.dots = this.dots || new DotLayer(width, height);
        this.dots.clear();
        this.paintActive(pen, (stamps, level, x, y) => this.dots!.add(stamps.imageOf(level), x * ratio, y * ratio));
        this.dots.draw(pen, ratio);
        this.paintRing(pen);
        canvas.style.touchAction = scene.isComplete && this.options.hasPointer !== false ? "pan-x pan-y" : "none";  // one finger pans a zoomed map
        if (this.options.drawn) this.options.drawn(this);
    }

    private idleLayer(): HTMLCanvasElement {
        if (this.idle) return this.idle;
        const [canvas, pen] = this.scene.layer();
        this.paintIdle(pen);
        return (this.idle = canvas);
    }

    private paintIdle(pen: Pen) {
        const room = this.distance * this.scene.scale, r = Math.max(0.5, Math.min(0.5 * this.scene.dotRadius, 0.22 * room));
        for (const {colour, first, end} of this.classes) {
            pen.fillStyle = resolved(mixed("var(--flesh)", colour, room > 14 ? 0.75 : 0.55));
            for (let mark = first; mark < end; ++mark) disc(pen, ...this.place(mark), r);
        }
    }

    /// Calls draw() for each active mark in sight. Marks of sparse classes have rings if the options say so.
    private paintActive(pen: Pen, draw: (stamps: DotStamps, level: number, x: number, y: number) => void) {
        const {scene, options, classes} = this, room = this.distance * scene.scale, hasRings = options.hasRings && room > 10;
        if (!this.stamps.length) this.stamps = classes.map(({colour}) => new DotStamps(colour, scene.dotRadius, options.ramp));
        this.active = 0;
        options.activity((mark, level) => {
            if (mark < this.from || mark >= this.to) return;
            ++this.active;
            const [x, y] = this.place(mark), k = classes.findIndex(({end}) => mark < end);
            if (x < -20 || y < -20 || x > scene.width + 20 || y > scene.height + 20) return;
            if (hasRings) fadingRing(pen, x, y, scene.dotRadius + (1 - level) * Math.min(0.8 * room, 26), level, classes[k].colour);
            draw(this.stamps[k], level, x, y);
        });
    }

    /// A ring around the chosen mark.
    private paintRing(pen: Pen) {
        const {chosen, dotRadius} = this.scene;
        if (chosen === null || chosen < this.from || chosen >= this.to) return;
        pen.strokeStyle = resolved("var(--ink)");
        pen.lineWidth = 1.5;
        circle(pen, ...this.place(chosen), dotRadius + 4);
    }

    /// The mark nearest to the point (x, y) of the map, if it is within `reach` pixels.
    nearestMark(x: number, y: number, reach = 12): number | null {
        let best: number | null = null, least = reach * reach;
        for (let mark = this.from; mark < this.to; ++mark) {
            const [px, py] = this.place(mark), square = (px - x) ** 2 + (py - y) ** 2;
            if (square < least) [best, least] = [mark, square];
        }
        return best;
    }

    /// The drawing as an SVG file.
    svg(): string {
        const pen = new SvgPen(), {width, height, surface} = this.scene;
        pen.fillStyle = resolved("var(--paper)");
        pen.fillRect(0, 0, width, height);
        surface.paintGround(pen);
        if (this.options.hasForce !== false) surface.paintForce(pen);
        this.paintIdle(pen);
        this.paintActive(pen, (stamps, level, x, y) => {
            pen.fillStyle = stamps.colourOf(level);
            disc(pen, x, y, stamps.radiusOf(level));
        });
        return pen.text(width, height, this.options.about);
    }
}
