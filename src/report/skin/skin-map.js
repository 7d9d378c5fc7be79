"use strict";
// A map of the skin for each class: sites in the background, afferents as marks, force and spikes above them.

const LEVELS = 16, TIME_STEPS = 32;  // number of colours for rates, and for times

/// The colours of increasing rates: from a tint of the class's colour to the colour itself, then towards the text colour.
function rateRamp(color) {
    const [paper, ink] = [colour("paper"), colour("ink")];
    return Array.from({length: LEVELS}, (_, k) => (k < LEVELS / 2 ? mixed(paper, color, 0.5 + k / LEVELS) : mixed(color, ink, (k - LEVELS / 2) / LEVELS * 1.3)));
}

/// The colours of increasing times, interpolated between the five of the style sheet.
function timeRamp() {
    const stops = [0, 1, 2, 3, 4].map((k) => colour("time-" + k));
    return Array.from({length: TIME_STEPS}, (_, k) => {
        const at = k / (TIME_STEPS - 1) * 4, stop = Math.min(3, Math.floor(at));
        return mixed(stops[stop], stops[stop + 1], at - stop);
    });
}

/// The map of one class, drawn in three layers: sites and all marks of the class (the idle layer), force, and the marks that have a value.
/// `values(map, call)` calls call(mark, level) for each mark with a value; the level is 0 to 1. `ramp(color)` returns the colours of the levels.
/// `force()` returns true if force is shown.
class SkinMap {
    constructor(host, scene, skinClass, {values, ramp, force}) {
        Object.assign(this, {scene, skin: scene.skin, skinClass, values, ramp, force, idle: null});
        this.root = element(host, "figure", "map");
        this.root.dataset.map = skinClass.name;
        this.canvas = element(this.root, "canvas");
        this.canvas.setAttribute("role", "img");
        this.caption = element(this.root, "figcaption");
        [this.from, this.to] = this.skin.marksOf(skinClass);
        this.positions = this.skin.markPositions.subarray(2 * this.from, 2 * this.to);
        this.radius = Math.min(1.2, 0.36 * spacing(this.positions));  // mm
        scene.maps.push(this);
        connectPointer(this);
    }

    /// Discards the layer and the colours, which depend on size, visible box and theme.
    renew() { this.idle = this.colours = null; }

    /// The position of a mark on the canvas, in pixels.
    place(mark) { return [this.scene.x(this.positions[2 * (mark - this.from)]), this.scene.y(this.positions[2 * (mark - this.from) + 1])]; }
    /// Radius of a mark, pixels.
    get pixels() { return Math.max(0.75, Math.min(5, this.radius * this.scene.scale)); }

    idleLayer() {
        if (this.idle) return this.idle;
        const [layer, context] = this.scene.canvas(), r = Math.max(0.55, this.pixels * 0.6);
        context.drawImage(this.scene.groundLayer(), 0, 0, this.scene.width, this.scene.height);
        context.fillStyle = mixed(colour("flesh"), this.skinClass.color, 0.3);
        for (let m = this.from; m < this.to; ++m) dot(context, ...this.place(m), r);
        return (this.idle = layer);
    }

    draw() {
        const {width, height} = this.scene, ratio = devicePixelRatio || 1, context = this.canvas.getContext("2d");
        if (this.canvas.width !== width * ratio || this.canvas.height !== height * ratio) {
            [this.canvas.width, this.canvas.height] = [width * ratio, height * ratio];
            Object.assign(this.canvas.style, {width: width + "px", height: height + "px"});
            this.root.style.width = width + "px";
        }
        context.setTransform(ratio, 0, 0, ratio, 0, 0);
        context.clearRect(0, 0, width, height);
        context.drawImage(this.idleLayer(), 0, 0, width, height);
        if (this.force()) context.drawImage(this.scene.forceLayer(), 0, 0, width, height);
        this.colours = this.colours || this.ramp(this.skinClass.color);
        const steps = this.colours.length, r = this.pixels;
        this.values(this, (mark, level) => {
            context.fillStyle = this.colours[Math.max(0, Math.min(steps - 1, Math.floor(level * steps)))];
            dot(context, ...this.place(mark), Math.max(1.5, r * (1.05 + 0.35 * level)));
        });
        this.drawRing(context);
    }

    /// A ring around the selected mark.
    drawRing(context) {
        const {chosen} = this.scene;
        if (chosen === null || chosen < this.from || chosen >= this.to) return;
        context.strokeStyle = colour("ink");
        context.lineWidth = 1.5;
        context.beginPath();
        context.arc(...this.place(chosen), this.pixels + 4, 0, 2 * Math.PI);
        context.stroke();
    }

    /// The mark nearest to the point (x, y) of the canvas, if it is within about 10 pixels; else null.
    nearestMark(x, y) {
        let best = null, minDistance = Math.max(10, 1.5 * this.pixels) ** 2;
        for (let m = this.from; m < this.to; ++m) {
            const [px, py] = this.place(m), distance = (px - x) ** 2 + (py - y) ** 2;  // squared
            if (distance < minDistance) [best, minDistance] = [m, distance];
        }
        return best;
    }
}

/// A disc; if it is small, a square, which is drawn faster.
function dot(context, x, y, r) {
    if (r < 1.6) return square(context, x, y, 2 * r);
    context.beginPath();
    context.arc(x, y, r, 0, 2 * Math.PI);
    context.fill();
}

/// Dragging pans, Ctrl with the wheel zooms, a double click shows the complete skin, and hovering selects a mark.
function connectPointer(map) {
    const {canvas, scene} = map;
    let drag = null;
    canvas.addEventListener("pointerdown", (event) => {
        if (event.button !== 0 || event.pointerType === "touch") return;
        drag = {x: event.offsetX, y: event.offsetY};
        canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
        if (drag) {
            scene.pan(event.offsetX - drag.x, event.offsetY - drag.y);
            drag = {x: event.offsetX, y: event.offsetY};
        } else scene.onPoint(map.nearestMark(event.offsetX, event.offsetY));
    });
    for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, () => { drag = null; });
    canvas.addEventListener("pointerleave", () => { if (!drag) scene.onPoint(null); });
    canvas.addEventListener("dblclick", () => scene.show(scene.all));
    canvas.addEventListener("wheel", (event) => {
        if (!event.ctrlKey) return;  // the wheel alone scrolls the page
        event.preventDefault();
        scene.zoom(1.2 ** Math.sign(event.deltaY), event.offsetX, event.offsetY);
    }, {passive: false});
}
