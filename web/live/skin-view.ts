// The skin under the pointer: its afferents, the spikes of the last moments, and the indenter.

import {classColour, resolved} from "../base/colours";
import {h} from "../base/dom";
import {fixedText, quantity} from "../base/text";
import {Places, SkinGeometry, spacing} from "../skin/geometry";
import {SkinScene} from "../skin/scene";
import {SkinMap} from "../skin/skin-map";
import type {Press} from "./press";
import type {Session, Skin} from "./session";

const SPIKE_SHOWN = 0.15;  // s for which a spike is shown

/// A place on the skin: 0.011034 m is "11.03 mm".
const millimetres = (metres: number) => fixedText(Number((1e3 * metres).toFixed(2)) || 0, 0.01, "mm");

export class SkinView {
    readonly root: HTMLElement;
    private host = h("div", {class: "skin-view-map"});
    private readout = h("p", {class: "readout", id: "skin-readout"});
    private scene: SkinScene | null = null;
    private active: [number, number][] = [];  // mark, level
    private drawn = "";                        // the press and the time that are drawn

    constructor(private session: Session, private press: Press) {
        const help = "Skin. Press with the pointer, or hold the space bar; Enter presses until Enter. Arrow keys move, with Shift faster; + and − change the force.";
        this.root = h("div", {class: "skin-view", tabindex: 0, role: "application", "aria-label": help, id: "skin-view"}, this.host, this.readout,
            h("p", {class: "hint"}, h("span", {class: "for-mouse"}, "Press and move. Wheel: force. Keys: hold space or Enter, arrows, + −."), h("span", {class: "for-touch"}, "Press with a finger, and move it.")));
        this.connectKeys();
        new ResizeObserver(() => this.resize()).observe(this.host);
    }

    /// Set by the page: multiplies the force, and shows it on its control.
    changeForce: (factor: number) => void = () => {};

    private connectPointer({canvas, scene}: SkinMap) {
        const {press} = this, follow = (event: PointerEvent) => press.moveTo(...scene.placeAt(event.offsetX, event.offsetY));
        canvas.addEventListener("pointerdown", (event) => {
            if (event.button !== 0) return;
            press.stop();
            follow(event);
            press.isDown = true;
            canvas.setPointerCapture(event.pointerId);
        });
        canvas.addEventListener("pointermove", (event) => { if (press.isDown) follow(event); });
        for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) canvas.addEventListener(end, () => { press.isDown = false; });
        canvas.addEventListener("wheel", (event) => {
            if (!press.isDown) return;
            event.preventDefault();
            this.changeForce(event.deltaY < 0 ? 1.1 : 1 / 1.1);
        }, {passive: false});
    }

    private connectKeys() {
        const {press} = this, step = (dx: number, dy: number) => (event: KeyboardEvent) => {
            const length = event.shiftKey ? 2e-3 : 0.4e-3;
            press.moveTo(press.x + dx * length, press.y + dy * length);
        };
        const keys: Record<string, (event: KeyboardEvent) => void> = {
            ArrowLeft: step(-1, 0), ArrowRight: step(1, 0), ArrowUp: step(0, 1), ArrowDown: step(0, -1),
            "+": () => this.changeForce(1.1), "=": () => this.changeForce(1.1), "-": () => this.changeForce(1 / 1.1),
            " ": () => { press.stop(); press.isDown = true; }, Enter: (event) => { if (!event.repeat) press.isDown = !press.isDown; },
        };
        this.root.addEventListener("keydown", (event) => {
            const isInMenu = (event.target as Element).closest(".menu") !== null;
            if (isInMenu || event.ctrlKey || event.altKey || event.metaKey || !keys[event.key]) return;
            event.preventDefault();
            event.stopPropagation();
            keys[event.key](event);
        });
        this.root.addEventListener("keyup", (event) => { if (event.key === " ") press.isDown = false; });
        this.root.addEventListener("focusout", ({relatedTarget}) => { if (!this.root.contains(relatedTarget as Node | null)) press.isDown = false; });
    }

    /// Draws the skin anew, after a start. The press moves to its middle.
    renew() {
        const {skin} = this.session;
        this.host.replaceChildren();
        this.root.hidden = !skin;
        this.scene?.remove();
        this.scene = null;
        this.drawn = "";
        if (!skin) return;
        this.scene = new SkinScene(geometryOf(skin, this.session.rows.length));
        const map = new SkinMap(this.scene, {host: this.host, name: "skin", title: [], about: "the skin, its active afferents, and the contact", classes: skin.classes.map((_, k) => k), hasForce: false, hasRings: true,
                                 activity: (draw) => this.active.forEach(([mark, level]) => draw(mark, level)), drawn: (one) => this.drawContact(one), hasPointer: false});
        this.connectPointer(map);
        this.press.moveTo(skin.x, skin.y);
        this.resize();
    }

    private resize() {
        const {clientWidth, clientHeight} = this.host;
        if (this.scene && clientWidth > 0) this.scene.resize(clientWidth, clientHeight);
    }

    redraw() { this.scene?.renew(); }

    /// Called at each frame of the screen. Draws only what differs from the frame before: a skin at rest does not occupy the processor.
    draw() {
        const {press, session: {skin, time, contactRadius}} = this;
        if (!skin || !this.scene) return;
        this.active = recentSpikes(skin, time);
        const shown = [press.x, press.y, press.force, contactRadius, this.active.length > 0 && time].join();
        if (shown === this.drawn) return;
        this.drawn = shown;
        this.scene.draw();
        this.readout.textContent = `${quantity(press.force, "N", true)} at ${millimetres(press.x)}, ${millimetres(press.y)}`;
    }

    private drawContact({canvas, scene}: SkinMap) {
        const {press} = this, pen = canvas.getContext("2d")!, x = scene.x(press.x), y = scene.y(press.y), radius = Math.max(this.session.contactRadius * scene.scale, 5);
        pen.strokeStyle = pen.fillStyle = resolved(press.force > 0 ? "var(--force)" : "var(--axis)");
        pen.lineWidth = 2;
        pen.beginPath();
        pen.arc(x, y, radius, 0, 2 * Math.PI);
        pen.stroke();
        pen.globalAlpha = 0.25;
        if (press.force > 0) pen.fill();
        pen.globalAlpha = 1;
    }
}

export function geometryOf(skin: Skin, firstUnit: number): SkinGeometry {
    const pairs = (x: Float32Array, y: Float32Array): Places => Float32Array.from({length: 2 * x.length}, (_, k) => (k % 2 ? y : x)[k >> 1]);
    const sites = pairs(skin.siteX, skin.siteY);
    return {outline: skin.outline, borders: skin.borders, sites, side: skin.site_side || 0.9 * spacing(sites), marks: pairs(skin.unitX, skin.unitY),
            classes: skin.classes.map(({name, first, count}) => ({name, colour: classColour(name), first: first - firstUnit, end: first - firstUnit + count}))};
}

/// The marks of the afferents that have just fired, and how bright they are.
export function recentSpikes({trains}: Skin, now: number): [number, number][] {
    const out: [number, number][] = [];
    trains.forEach(({times}, mark) => {
        const age = times.length ? now - times[times.length - 1] : SPIKE_SHOWN;
        if (age < SPIKE_SHOWN) out.push([mark, 1 - Math.max(0, age) / SPIKE_SHOWN]);
    });
    return out;
}
