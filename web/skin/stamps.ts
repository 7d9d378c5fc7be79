// Images of active marks, one for each of some levels, and the colours of levels.

import {mixed, resolved} from "../base/colours";
import {h, pixelRatio} from "../base/dom";

export const LEVELS = 16;
const HALO = 2.3;  // radius of a halo over that of its mark

/// The colours of increasing levels: from a tint of the class's colour to the colour itself, then towards the colour of the text.
export const rateRamp = (colour: string) => Array.from({length: LEVELS}, (_, k) => (k < LEVELS / 2 ? mixed("var(--paper)", colour, 0.5 + k / LEVELS) : mixed(colour, "var(--ink)", (k - LEVELS / 2) / LEVELS * 0.7)));

/// The colours of increasing times, from early to late.
export const timeRamp = () => Array.from({length: 32}, (_, k) => {
    const at = k / 31 * 4, stop = Math.min(3, Math.floor(at));
    return mixed(`var(--time-${stop})`, `var(--time-${stop + 1})`, at - stop);
});

/// A square image; `side` in pixels of the screen.
export interface DotImage { pixels: Uint32Array; side: number }

/// `radius`: of a mark, CSS pixels. A mark of level 1 is larger than one of level 0, and has a halo. If there is a ramp, it is one of times, and all
/// marks are equally large.
export class DotStamps {
    private colours: string[];
    private images: DotImage[];

    constructor(colour: string, private radius: number, private ramp: ((colour: string) => string[]) | undefined) {
        this.colours = (ramp || rateRamp)(colour).map(resolved);
        this.images = this.colours.map((_, k) => this.image(k));
    }

    private index(level: number) { return Math.max(0, Math.min(this.colours.length - 1, Math.floor(level * this.colours.length))); }
    colourOf(level: number) { return this.colours[this.index(level)]; }
    imageOf(level: number) { return this.images[this.index(level)]; }
    radiusOf(level: number) { return this.radius * (this.ramp ? 1 : 0.85 + 0.35 * level); }

    private image(k: number): DotImage {
        const ratio = pixelRatio(), level = k / (this.colours.length - 1), r = this.radiusOf(level), side = Math.ceil((2 * (this.ramp ? 1 : HALO) * r + 2) * ratio);
        const pen = h("canvas", {width: side, height: side}).getContext("2d", {willReadFrequently: true})!, middle = side / ratio / 2;
        pen.scale(ratio, ratio);
        if (!this.ramp) this.paintHalo(pen, k, level, r, middle);
        pen.fillStyle = this.colours[k];
        pen.beginPath();
        pen.arc(middle, middle, r, 0, 2 * Math.PI);
        pen.fill();
        return {pixels: new Uint32Array(pen.getImageData(0, 0, side, side).data.buffer), side};
    }

    private paintHalo(pen: CanvasRenderingContext2D, k: number, level: number, r: number, middle: number) {
        const halo = pen.createRadialGradient(middle, middle, r * 0.8, middle, middle, r * HALO);
        halo.addColorStop(0, this.colours[k]);
        halo.addColorStop(1, this.colours[k].replace("rgb(", "rgba(").replace(")", ", 0)"));
        pen.globalAlpha = 0.1 + 0.35 * level;
        pen.fillStyle = halo;
        pen.fillRect(0, 0, 2 * middle, 2 * middle);
        pen.globalAlpha = 1;
    }
}
