"use strict";
// The shared state of all maps.

/// The visible box, the size, and the layers that all maps share: the background of sites and the force on it.
class Scene {
    constructor(skin) {
        Object.assign(this, {skin, maps: [], frame: 0, chosen: null, waiting: false});
        this.all = grown(joined(extentOfPlaces(skin.sitePositions), extentOfPlaces(skin.markPositions)), skin.side);
        this.box = this.all;
        this.frameForce = null;
    }

    /// Arranges the maps in a row, as large as the window allows.
    layOut(width) {
        const count = this.skin.classes.length, [x0, y0, x1, y1] = this.all, aspect = Math.max(0.3, Math.min(3.5, (x1 - x0) / (y1 - y0)));
        const maxHeight = Math.max(260, Math.min(600, 0.58 * innerHeight));
        const mapWidth = (columns) => Math.min((width - 12 * (columns - 1)) / columns, Math.max(maxHeight * aspect, 170));
        let columns = count;
        while (columns > 1 && mapWidth(columns) < Math.min(165, 0.9 * maxHeight * aspect)) columns = Math.ceil(columns / 2);
        [this.width, this.height] = [Math.floor(mapWidth(columns)), Math.floor(Math.max(60, Math.min(maxHeight, mapWidth(columns) / aspect)))];
        this.renew();
    }

    /// Discards cached layers, which depend on size, visible box and colours.
    renew() {
        const [x0, y0, x1, y1] = this.box;
        this.scale = Math.min(this.width / (x1 - x0), this.height / (y1 - y0));  // pixels per mm
        [this.cx, this.cy] = [(x0 + x1) / 2, (y0 + y1) / 2];
        this.ground = this.frameForce = null;
        this.maps.forEach((map) => map.renew());
        this.request();
    }

    x(mm) { return this.width / 2 + (mm - this.cx) * this.scale; }
    y(mm) { return this.height / 2 - (mm - this.cy) * this.scale; }

    show(box) {
        this.box = box;
        this.renew();
    }

    /// Zooms about the point (x, y) of a map, in pixels.
    zoom(factor, x = this.width / 2, y = this.height / 2) {
        const [mx, my] = [this.cx + (x - this.width / 2) / this.scale, this.cy - (y - this.height / 2) / this.scale];
        const [w, h] = [this.width / this.scale * factor, this.height / this.scale * factor];
        const cx = mx - (mx - this.cx) * factor, cy = my - (my - this.cy) * factor;
        if (w > 1.5 * (this.all[2] - this.all[0]) && h > 1.5 * (this.all[3] - this.all[1])) return this.show(this.all);
        this.show([cx - w / 2, cy - h / 2, cx + w / 2, cy + h / 2]);
    }

    pan(dx, dy) {
        const [mx, my] = [-dx / this.scale, dy / this.scale], [x0, y0, x1, y1] = this.box;
        this.show([x0 + mx, y0 + my, x1 + mx, y1 + my]);
    }

    request() {
        if (!this.waiting) requestAnimationFrame(() => this.draw());
        this.waiting = true;
    }

    draw() {
        this.waiting = false;
        this.maps.forEach((map) => map.draw());
    }

    canvas() {
        const layer = document.createElement("canvas"), ratio = devicePixelRatio || 1;
        [layer.width, layer.height] = [this.width * ratio, this.height * ratio];
        const context = layer.getContext("2d");
        context.scale(ratio, ratio);
        return [layer, context];
    }

    /// Sites as adjacent squares. All are first drawn larger in the edge colour, which leaves a common outline.
    groundLayer() {
        if (this.ground) return this.ground;
        const [layer, context] = this.canvas(), side = this.skin.side * this.scale;
        for (const [color, more] of [["flesh-edge", 2.4], ["flesh", 0.6]]) {
            context.fillStyle = colour(color);
            this.eachSite((x, y) => square(context, x, y, side + more));
        }
        return (this.ground = layer);
    }

    eachSite(call) {
        const {sitePositions} = this.skin;
        for (let s = 0; 2 * s < sitePositions.length; ++s) call(this.x(sitePositions[2 * s]), this.y(sitePositions[2 * s + 1]), s);
    }

    /// Mean force of each site in the frame, as opacity.
    forceLayer() {
        if (this.frameForce && this.frameForce.frame === this.frame) return this.frameForce.layer;
        const [layer, context] = this.canvas(), {siteForce, sitePositions, sitesPerMark} = this.skin, side = this.skin.side * this.scale + 0.6;
        context.fillStyle = colour("force");
        if (this.frame < siteForce.count)
            siteForce.each(this.frame, (place, level) => {
                context.globalAlpha = 0.12 + 0.68 * level / 254;
                for (let s = place * sitesPerMark; s < (place + 1) * sitesPerMark && 2 * s < sitePositions.length; ++s)
                    square(context, this.x(sitePositions[2 * s]), this.y(sitePositions[2 * s + 1]), side);
            });
        this.frameForce = {frame: this.frame, layer};
        return layer;
    }
}

function square(context, x, y, side) { context.fillRect(x - side / 2, y - side / 2, side, side); }
const joined = (a, b) => [Math.min(a[0], b[0]), Math.min(a[1], b[1]), Math.max(a[2], b[2]), Math.max(a[3], b[3])];
const grown = ([x0, y0, x1, y1], by) => [x0 - by, y0 - by, x1 + by, y1 + by];
