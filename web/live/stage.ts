// The skin under the pointer: its sites, its afferents, the spikes of the last moments, and the indenter.

import {classColour, resolved} from "../base/colours";
import {h} from "../base/dom";
import {quantity} from "../base/text";
import type {Press} from "./press";
import type {Session, Skin} from "./session";

const GLOW = 0.12;  // s for which a spike is shown

export class Stage {
    readonly root: HTMLElement;
    private canvas = h("canvas", {});
    private readout = h("p", {class: "readout", id: "stage-readout"});
    private ground: HTMLCanvasElement | null = null;  // sites and afferents at rest
    private size = "";
    private scale = 1;  // pixels per metre
    private left = 0;   // of the canvas's middle, m
    private low = 0;

    constructor(private session: Session, private press: Press) {
        const help = "Skin. Press with the pointer, or hold the space bar; Enter presses until Enter. Arrow keys move, with Shift faster; + and − change the force.";
        this.root = h("div", {class: "stage", tabindex: 0, role: "application", "aria-label": help, id: "stage"}, this.canvas, this.readout,
            h("p", {class: "hint"}, h("span", {class: "for-mouse"}, "Press and move. Wheel: force. Keys: hold space or Enter, arrows, + −."), h("span", {class: "for-touch"}, "Press with a finger, and move it.")));
        this.connectPointer();
        this.connectKeys();
    }

    private get skin(): Skin | null { return this.session.skin; }

    private connectPointer() {
        const {canvas, press} = this, follow = (event: PointerEvent) => {
            const box = canvas.getBoundingClientRect();
            press.moveTo(this.left + (event.clientX - box.left - box.width / 2) / this.scale, this.low - (event.clientY - box.top - box.height / 2) / this.scale);
        };
        canvas.addEventListener("pointerdown", (event) => {
            press.stop();
            follow(event);
            press.isDown = true;
            canvas.setPointerCapture(event.pointerId);
        });
        canvas.addEventListener("pointermove", (event) => { if (press.isDown) follow(event); });
        for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) canvas.addEventListener(end, () => { press.isDown = false; });
        canvas.addEventListener("wheel", (event) => {
            if (!press.isDown && !this.root.contains(document.activeElement)) return;
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
            if (event.ctrlKey || event.altKey || event.metaKey || !keys[event.key]) return;
            event.preventDefault();
            event.stopPropagation();
            keys[event.key](event);
        });
        this.root.addEventListener("keyup", (event) => { if (event.key === " ") press.isDown = false; });
        this.root.addEventListener("blur", () => { press.isDown = false; });
    }

    /// Set by the page: changes the force and its control.
    changeForce: (factor: number) => void = () => {};

    /// Called after a start, or if the theme changes.
    renew() {
        this.ground = null;
        const {skin} = this;
        if (skin) this.press.moveTo((skin.left + skin.right) / 2, (skin.low + skin.high) / 2);
    }

    draw() {
        const {skin, canvas} = this, ratio = devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
        this.root.hidden = !skin;
        if (!skin || width === 0) return;
        if (this.size !== `${width}x${height}x${ratio}`) this.ground = null;
        this.size = `${width}x${height}x${ratio}`;
        if (!this.ground) this.drawGround(skin, width, height, ratio);
        const pen = canvas.getContext("2d")!;
        pen.setTransform(1, 0, 0, 1, 0, 0);
        pen.drawImage(this.ground!, 0, 0);
        pen.setTransform(ratio, 0, 0, ratio, 0, 0);
        this.drawContact(pen, width, height);
        this.drawSpikes(pen, skin, width, height);
        this.readout.textContent = `${quantity(this.press.force, "N", true)} at ${quantity(this.press.x, "m", true)}, ${quantity(this.press.y, "m", true)}`;
    }

    private place(x: number, y: number, width: number, height: number): [number, number] { return [width / 2 + (x - this.left) * this.scale, height / 2 - (y - this.low) * this.scale]; }

    private drawGround(skin: Skin, width: number, height: number, ratio: number) {
        [this.canvas.width, this.canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
        const layer = (this.ground = h("canvas", {width: this.canvas.width, height: this.canvas.height})), pen = layer.getContext("2d")!;
        this.scale = 0.94 * Math.min(width / (skin.right - skin.left), height / (skin.high - skin.low));
        [this.left, this.low] = [(skin.left + skin.right) / 2, (skin.low + skin.high) / 2];
        pen.setTransform(ratio, 0, 0, ratio, 0, 0);
        pen.fillStyle = resolved("var(--paper)");
        pen.fillRect(0, 0, width, height);
        pen.fillStyle = resolved("var(--flesh)");
        const radius = Math.max(1, 0.9 * skin.site_side * this.scale);
        for (let s = 0; s < skin.site_x.length; ++s) dot(pen, this.place(skin.site_x[s], skin.site_y[s], width, height), radius);
        pen.globalAlpha = 0.45;
        for (let u = 0; u < skin.x.length; ++u) {
            pen.fillStyle = resolved(classColour(skin.classes[skin.class[u]].name));
            dot(pen, this.place(skin.x[u], skin.y[u], width, height), 1.3);
        }
    }

    private drawContact(pen: CanvasRenderingContext2D, width: number, height: number) {
        const {press} = this, [x, y] = this.place(press.x, press.y, width, height), radius = Math.max(this.session.contactRadius * this.scale, 5);
        pen.strokeStyle = resolved(press.force > 0 ? "var(--force)" : "var(--axis)");
        pen.fillStyle = resolved("var(--force)");
        pen.lineWidth = 2;
        pen.globalAlpha = 0.35;
        if (press.force > 0) dot(pen, [x, y], radius);
        pen.globalAlpha = 1;
        pen.beginPath();
        pen.arc(x, y, radius, 0, 2 * Math.PI);
        pen.stroke();
    }

    /// A spike is a mark that fades. An afferent whose spikes are frequent stays lit.
    private drawSpikes(pen: CanvasRenderingContext2D, skin: Skin, width: number, height: number) {
        const now = this.session.time;
        for (let u = 0; u < skin.trains.length; ++u) {
            const {times} = skin.trains[u], age = times.length ? now - times[times.length - 1] : GLOW;
            if (age >= GLOW) continue;
            pen.globalAlpha = 1 - Math.max(0, age) / GLOW;
            pen.fillStyle = resolved(classColour(skin.classes[skin.class[u]].name));
            dot(pen, this.place(skin.x[u], skin.y[u], width, height), 3.6);
        }
        pen.globalAlpha = 1;
    }
}

function dot(pen: CanvasRenderingContext2D, [x, y]: [number, number], radius: number) {
    pen.beginPath();
    pen.arc(x, y, radius, 0, 2 * Math.PI);
    pen.fill();
}
