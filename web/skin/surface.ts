// The layers that all maps have in common: the skin, and the force on it.

import {components, resolved} from "../base/colours";
import {h} from "../base/dom";
import type {Pen} from "../plot/pen";
import {Places, boxOf} from "./geometry";
import type {SkinScene} from "./scene";

/// Calls draw(index, level) for some sites or marks; a level is 0 to 1. The others have none.
export type Levels = (draw: (index: number, level: number) => void) => void;

export class Surface {
    private ground: HTMLCanvasElement | null = null;
    private pressed: HTMLCanvasElement;  // one pixel per site, or as large as a map if the sites are separate
    private isForceOld = true;
    private corner: [number, number];    // smallest x and y of the sites

    constructor(private scene: SkinScene, private force: Levels) {
        const {sites, side} = scene.geometry, [x0, y0, x1, y1] = boxOf(sites), pixels = (length: number) => Math.round(length / side) + 1;
        this.corner = [x0, y0];
        this.pressed = this.isContinuous ? h("canvas", {width: pixels(x1 - x0), height: pixels(y1 - y0)}) : h("canvas");
    }

    /// True if the sites are cells of a continuous skin, false if they are separate sensors.
    get isContinuous() { return this.scene.geometry.outline.length > 0; }

    renew() {
        this.ground = null;
        this.isForceOld = true;
    }

    forceChanged() { this.isForceOld = true; }

    /// The skin with its outline and regions, or its sensors.
    groundLayer(): HTMLCanvasElement {
        if (this.ground) return this.ground;
        const [canvas, pen] = this.scene.layer();
        this.paintGround(pen);
        return (this.ground = canvas);
    }

    paintGround(pen: Pen) {
        const shape = this.isContinuous ? this.scene.geometry.outline : this.sensors();
        pen.lineJoin = "round";
        pen.fillStyle = resolved("var(--flesh)");
        this.trace(pen, shape);
        pen.fill();
        for (const [polygons, colour, width] of [[this.scene.geometry.borders, "var(--flesh-crease)", 1], [shape, "var(--flesh-edge)", 1.5]] as [Places[], string, number][]) {
            pen.strokeStyle = resolved(colour);
            pen.lineWidth = width;
            this.trace(pen, polygons);
            pen.stroke();
        }
    }

    private sensors(): Places[] { return Array.from({length: this.scene.geometry.sites.length / 2}, (_, s) => this.sensor(s)); }

    /// The square of a sensor.
    private sensor(site: number): Places {
        const {sites, side} = this.scene.geometry, x = sites[2 * site], y = sites[2 * site + 1], r = 0.47 * side;
        return Float32Array.of(x - r, y - r, x + r, y - r, x + r, y + r, x - r, y + r);
    }

    private trace(pen: Pen, polygons: Places[]) {
        pen.beginPath();
        for (const points of polygons) {
            for (let k = 0; k < points.length; k += 2) pen[k ? "lineTo" : "moveTo"](this.scene.x(points[k]), this.scene.y(points[k + 1]));
            pen.closePath();
        }
    }

    /// The force, as opacity of one colour.
    paintForce(pen: Pen) {
        const {scene} = this, {geometry, scale} = scene, {side} = geometry;
        if (this.isForceOld) this.isContinuous ? this.renewPixels() : this.renewSensors();
        this.isForceOld = false;
        const {width, height} = this.pressed;
        if (!this.isContinuous) return pen.drawImage(this.pressed, 0, 0, width, height, 0, 0, scene.width, scene.height);
        pen.save();
        this.trace(pen, geometry.outline);
        pen.clip();
        pen.imageSmoothingEnabled = true;
        pen.drawImage(this.pressed, 0, 0, width, height, scene.x(this.corner[0] - side / 2), scene.y(this.corner[1] + (height - 0.5) * side), width * side * scale, height * side * scale);
        pen.restore();
    }

    private renewPixels() {
        const {sites, side} = this.scene.geometry, {width, height} = this.pressed, image = new ImageData(width, height), [r, g, b] = components("var(--force)");
        this.force((site, level) => {
            const column = Math.round((sites[2 * site] - this.corner[0]) / side), row = height - 1 - Math.round((sites[2 * site + 1] - this.corner[1]) / side);
            image.data.set([r, g, b, forceOpacity(level) * 255], 4 * (row * width + column));
        });
        this.pressed.getContext("2d")!.putImageData(image, 0, 0);
    }

    private renewSensors() {
        const [canvas, pen] = this.scene.layer();
        pen.fillStyle = resolved("var(--force)");
        this.force((site, level) => {
            pen.globalAlpha = forceOpacity(level);
            this.trace(pen, [this.sensor(site)]);
            pen.fill();
        });
        this.pressed = canvas;
    }
}

/// The opacity of a level of force.
export const forceOpacity = (level: number) => 0.85 * Math.min(1, Math.max(0, level)) ** 0.7;
