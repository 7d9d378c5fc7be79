// Draws thousands of active marks at once: their images are copied into the pixels of one image. Where they overlap, the more opaque pixel is kept.

import {h} from "../base/dom";
import type {DotImage} from "./stamps";

export class DotLayer {
    private canvas: HTMLCanvasElement;
    private image: ImageData;
    private pixels: Uint32Array;
    private left = 0;  // columns and rows with marks: left ... right - 1, top ... bottom - 1
    private top = 0;
    private right = 0;
    private bottom = 0;

    /// Width and height in pixels of the screen.
    constructor(private width: number, private height: number) {
        this.canvas = h("canvas", {width, height});
        this.image = new ImageData(width, height);
        this.pixels = new Uint32Array(this.image.data.buffer);
    }

    clear() {
        this.pixels.fill(0);
        [this.left, this.top, this.right, this.bottom] = [this.width, this.height, 0, 0];
    }

    /// Adds an image whose middle is at (x, y).
    add({pixels, side}: DotImage, x: number, y: number) {
        const left = Math.round(x - side / 2), top = Math.round(y - side / 2);
        const x0 = Math.max(0, left), x1 = Math.min(this.width, left + side), y0 = Math.max(0, top), y1 = Math.min(this.height, top + side);
        for (let row = y0; row < y1; ++row)
            for (let column = x0, to = row * this.width + x0, from = (row - top) * side + x0 - left; column < x1; ++column, ++to, ++from)
                if (pixels[from] >>> 24 > this.pixels[to] >>> 24) this.pixels[to] = pixels[from];
        [this.left, this.top, this.right, this.bottom] = [Math.min(this.left, x0), Math.min(this.top, y0), Math.max(this.right, x1), Math.max(this.bottom, y1)];
    }

    /// Draws the marks. `ratio`: pixels of the screen per CSS pixel.
    draw(pen: CanvasRenderingContext2D, ratio: number) {
        const w = this.right - this.left, height = this.bottom - this.top;
        if (w <= 0 || height <= 0) return;
        this.canvas.getContext("2d")!.putImageData(this.image, 0, 0, this.left, this.top, w, height);
        pen.drawImage(this.canvas, this.left, this.top, w, height, this.left / ratio, this.top / ratio, w / ratio, height / ratio);
    }
}
