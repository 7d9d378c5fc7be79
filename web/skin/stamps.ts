// Images of active marks, one for each of some levels, so that thousands can be drawn per frame.

import {mixed, resolved} from "../base/colours";
import {h} from "../base/dom";

export const LEVELS = 16;

/// The colours of increasing levels: from a tint of the class's colour to the colour itself, then towards the colour of the text.
export const rateRamp = (colour: string) => Array.from({length: LEVELS}, (_, k) => (k < LEVELS / 2 ? mixed("var(--paper)", colour, 0.5 + k / LEVELS) : mixed(colour, "var(--ink)", (k - LEVELS / 2) / LEVELS * 0.7)));

/// The colours of increasing times, from early to late.
export const timeRamp = () => Array.from({length: 32}, (_, k) => {
    const at = k / 31 * 4, stop = Math.min(3, Math.floor(at));
    return mixed(`var(--time-${stop})`, `var(--time-${stop + 1})`, at - stop);
});

/// `radius`: of a mark, CSS pixels. A mark of level 1 is larger than one of level 0, and has a halo.
export class DotStamps {
    private colours: string[];
    private sheet: HTMLCanvasElement;
    private side: number;  // of an image, CSS pixels

    constructor(colour: string, private radius: number, private ramp: ((colour: string) => string[]) | undefined) {
        this.colours = (ramp || rateRamp)(colour).map(resolved);
        this.side = Math.ceil(2 * HALO * this.radiusOf(1)) + 2;
        const ratio = devicePixelRatio || 1;
        this.sheet = h("canvas", {width: Math.ceil(this.side * this.colours.length * ratio), height: Math.ceil(this.side * ratio)});
        const pen = this.sheet.getContext("2d")!;
        pen.scale(ratio, ratio);
        this.colours.forEach((_, k) => this.paint(pen, k));
    }

    private index(level: number) { return Math.max(0, Math.min(this.colours.length - 1, Math.floor(level * this.colours.length))); }
    colourOf(level: number) { return this.colours[this.index(level)]; }
    /// All marks have one size if the ramp is one of times.
    radiusOf(level: number) { return this.radius * (this.ramp ? 1 : 0.85 + 0.35 * level); }

    private paint(pen: CanvasRenderingContext2D, k: number) {
        const level = k / (this.colours.length - 1), r = this.radiusOf(level), x = (k + 0.5) * this.side, y = this.side / 2;
        if (!this.ramp) {
            const halo = pen.createRadialGradient(x, y, r * 0.8, x, y, r * HALO);
            halo.addColorStop(0, this.colours[k]);
            halo.addColorStop(1, this.colours[k].replace("rgb(", "rgba(").replace(")", ", 0)"));
            pen.globalAlpha = 0.1 + 0.35 * level;
            pen.fillStyle = halo;
            pen.fillRect(x - this.side / 2, 0, this.side, this.side);
        }
        pen.globalAlpha = 1;
        pen.fillStyle = this.colours[k];
        pen.beginPath();
        pen.arc(x, y, r, 0, 2 * Math.PI);
        pen.fill();
    }

    draw(pen: CanvasRenderingContext2D, level: number, x: number, y: number) {
        const part = this.sheet.width / this.colours.length;
        pen.drawImage(this.sheet, this.index(level) * part, 0, part, this.sheet.height, x - this.side / 2, y - this.side / 2, this.side, this.side);
    }
}

const HALO = 2.3;  // radius of a halo over that of its mark
