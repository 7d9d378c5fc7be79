"use strict";
// The state that all maps share.

/// For all maps: the visible box (mm), their size (pixels), the selected mark, the frame that they show, and the layers that are equal on all of
/// them, which are the sites and the force. `all`: the box of the complete skin. `onPoint(mark)`, set by the page, is called when the pointer
/// moves to a mark, or with null.
class Scene {
    constructor(skin) {
        Object.assign(this, {skin, maps: [], frame: 0, chosen: null, waiting: false});  // chosen: index of the selected mark, or null
        this.all = grown(joined(extentOfPlaces(skin.sitePositions), extentOfPlaces(skin.markPositions)), skin.side);
        this.box = this.all;
        this.frameForce = null;
    }

    /// Sets the size of the maps, as large as the window allows: all in one row of `width` pixels if they fit, else in several rows.
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

    // Coordinates of the skin as pixels of a map.
    x(mm) { return this.width / 2 + (mm - this.cx) * this.scale; }
    y(mm) { return this.height / 2 - (mm - this.cy) * this.scale; }

    show(box) {
        this.box = box;
        this.renew();
    }

    /// Multiplies the size of the visible box by `factor`. The point (x, y) of a map, in pixels, keeps its place. Shows the complete skin if the box
    /// would become much larger than that.
    zoom(factor, x = this.width / 2, y = this.height / 2) {
        const [mx, my] = [this.cx + (x - this.width / 2) / this.scale, this.cy - (y - this.height / 2) / this.scale];
        const [w, h] = [this.width / this.scale * factor, this.height / this.scale * factor];
        const cx = mx - (mx - this.cx) * factor, cy = my - (my - this.cy) * factor;
        if (w > 1.5 * (this.all[2] - this.all[0]) && h > 1.5 * (this.all[3] - this.all[1])) return this.show(this.all);
        this.show([cx - w / 2, cy - h / 2, cx + w / 2, cy + h / 2]);
    }

    /// Moves the skin by pixels.
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

    /// A new layer of the maps' size, and its context, which is scaled to CSS pixels.
    canvas() {
        const layer = document.createElement("canvas"), ratio = devicePixelRatio || 1;
        [layer.width, layer.height] = [this.width * ratio, this.height * ratio];
        const context = layer.getContext("2d");
        context.scale(ratio, ratio);
        return [layer, context];
    }

    /// The layer of the sites, which are adjacent squares. All squares are first drawn larger in the edge colour, which leaves an outline around
    /// the skin.
    groundLayer() {
        if (this.ground) return this.ground;
        const [layer, context] = this.canvas(), side = this.skin.side * this.scale;
        for (const [color, more] of [["flesh-edge", 2.4], ["flesh", 0.6]]) {
            context.fillStyle = colour(color);
            this.eachSite((x, y) => square(context, x, y, side + more));
        }
        return (this.ground = layer);
    }

    /// Calls call(x, y, site) for each site, with its position in pixels.
    eachSite(call) {
        const {sitePositions} = this.skin;
        for (let s = 0; 2 * s < sitePositions.length; ++s) call(this.x(sitePositions[2 * s]), this.y(sitePositions[2 * s + 1]), s);
    }

    /// The layer of the force: the mean force of each mark of sites in the current frame, as opacity. Level 254 is the maximum.
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
