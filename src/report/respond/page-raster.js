"use strict";
// Raster of the spikes of all afferents and channels. If there are many spikes, the time to draw it depends on the number of pixels only.

const MAX_LABELS = 46;  // if there are more lanes, there is no space for a label per lane

/// Each lane is a row of the raster: an afferent, or a copy of one, on a channel. Spikes are ticks if they can be distinguished, else the number of
/// spikes per pixel is shown as shades.
class RasterPanel extends Panel {
    /// `lanes`: [{afferent, group, label, color, spikes, channel, chosen}], the first at the top; `chosen`: the lane is on the selected channel.
    /// `pick(channel)` is called when a lane is clicked; null if a click does nothing. `grouped`: draw a line where the `group` of lanes changes.
    /// `afferents`: [{name, color}] for the legend.
    constructor({lanes, pick, grouped, afferents, named, ...rest}) {
        const laneHeight = Math.min(24, 560 / lanes.length), strip = named ? 16 : 0;
        super({...rest, named, title: "spikes", height: strip + Math.max(40, laneHeight * lanes.length), bottom: true,
               series: afferents.map(({name, color}) => ({label: name, html: escaped(name), color, width: 3}))});
        Object.assign(this, {lanes, pick, grouped, strip, labelEach: lanes.length <= MAX_LABELS});
    }

    rows() { return []; }
    options() { return {drawGrid: false}; }
    showValues() {}
    clearValues() {}

    /// A lane has height 1; the strip above the lanes is for the names of the phases.
    range() { return [0, this.lanes.length * this.height / (this.height - this.strip)]; }
    /// The area of the lanes, which is below the strip, and the height of a lane in pixels.
    inner(area) { return {...area, y: area.y + this.strip, h: area.h - this.strip, laneHeight: (area.h - this.strip) / this.lanes.length}; }

    /// A label for each lane if there is space, else one for each afferent in the middle of its lanes.
    valueTicks() {
        const n = this.lanes.length;
        if (this.labelEach) return this.lanes.map(({label}, k) => ({v: n - k - 0.5, label: escaped(label)}));
        return this.series.map(({label}) => {
            const first = this.lanes.findIndex((lane) => lane.afferent === label);
            const last = this.lanes.findLastIndex((lane) => lane.afferent === label);
            return {v: n - (first + last + 1) / 2, label: escaped(label)};
        });
    }

    drawBackground(context, outer) {
        super.drawBackground(context, outer);
        const area = this.inner(outer);
        const [a, b] = this.chart.xAxisRange();
        const visible = this.lanes.map(({spikes}) => [spikes.before(a), spikes.before(b)]);
        const maxCount = visible.reduce((max, [i, j]) => Math.max(max, j - i), 0);
        const total = visible.reduce((sum, [i, j]) => sum + j - i, 0);
        this.markLanes(context, area);
        if (maxCount * 4 < area.w && total < 20000) this.drawTicks(context, area, visible);
        else this.drawDensity(context, area, a, b, visible);
        this.countSpikes(visible);
    }

    /// Tints the lanes of the selected channel and draws a line between groups.
    markLanes(context, area) {
        if (!this.grouped) return;
        const [tint, rule] = [colour("chosen"), colour("rule")];
        this.lanes.forEach((lane, k) => {
            const y = area.y + k * area.laneHeight;
            context.fillStyle = tint;
            if (this.pick && lane.chosen) context.fillRect(area.x, y, area.w, Math.max(area.laneHeight, 2));
            context.fillStyle = rule;
            if (k && lane.group !== this.lanes[k - 1].group) context.fillRect(area.x, Math.round(y), area.w, 1);
        });
    }

    drawTicks(context, area, visible) {
        const {laneHeight} = area, gap = laneHeight > 4 ? laneHeight * 0.12 : 0;
        this.lanes.forEach(({spikes, color}, k) => {
            context.fillStyle = color;
            for (let i = visible[k][0]; i < visible[k][1]; ++i)
                context.fillRect(this.chart.toDomXCoord(spikes.times[i]) - 0.75, area.y + k * laneHeight + gap, 1.5, Math.max(1, laneHeight - 2 * gap));
        });
    }

    /// Paints an image with one pixel per line and column, then scales it to the plot. A line is one lane, or several if lanes are thinner than
    /// a pixel of the screen.
    drawDensity(context, area, a, b, visible) {
        const columns = Math.round(area.w * devicePixelRatio);
        const lines = Math.min(this.lanes.length, Math.floor(area.h * devicePixelRatio));
        const counts = Array.from({length: lines}, () => new Uint32Array(columns));
        const colours = [];
        this.lanes.forEach(({spikes, color}, k) => {
            const line = Math.floor(k * lines / this.lanes.length);
            countPerColumn(counts[line], spikes, ...visible[k], a, b);
            colours[line] = color;
        });
        const image = painted(counts, colours), gap = area.laneHeight > 6 ? 1 : 0;
        context.imageSmoothingEnabled = false;
        for (let k = 0; k < lines; ++k)
            context.drawImage(image, 0, k, columns, 1, area.x, area.y + k * area.h / lines + gap, area.w, area.h / lines - 2 * gap);
    }

    /// Shows in the legend how many spikes of each afferent on the selected channel (with copies, of all copies shown) are visible.
    countSpikes(visible) {
        this.series.forEach(({label}, s) => {
            let [shown, total] = [0, 0];
            this.lanes.forEach((lane, k) => {
                if (lane.afferent === label && lane.chosen) [shown, total] = [shown + visible[k][1] - visible[k][0], total + lane.spikes.count];
            });
            this.values[s].textContent = shown === total ? `${total}` : `${shown} of ${total}`;
        });
    }

    click(x, y) {
        const area = this.inner(this.area);
        const lane = this.lanes[Math.floor((y - area.y) / area.laneHeight)];
        if (lane && this.pick && !lane.chosen) this.pick(lane.channel);
    }
}

/// Adds spikes i ... j-1 of a train to the counts of the pixel columns that divide the time range [a, b) equally. Few spikes are counted one
/// by one; if there are many, the first spike of each column is found by binary search.
function countPerColumn(counts, spikes, i, j, a, b) {
    const t = spikes.times, columns = counts.length;
    if (j - i < 8 * columns) {
        for (let k = i; k < j; ++k) ++counts[Math.min(columns - 1, Math.floor((t[k] - a) / (b - a) * columns))];
        return;
    }
    for (let c = 0, from = i; c < columns; ++c) {
        const to = c + 1 < columns ? spikes.before(a + (b - a) * (c + 1) / columns) : j;
        counts[c] += to - from;
        from = to;
    }
}

/// A canvas with one pixel per count, in the colour of its line: more spikes are more opaque, and one spike has at least the opacity `minAlpha`
/// of 255.
function painted(counts, colours, minAlpha = 55) {
    const max = counts.reduce((high, line) => line.reduce((m, n) => Math.max(m, n), high), 1);
    const canvas = element(null, "canvas");
    [canvas.width, canvas.height] = [counts[0].length, counts.length];
    const image = new ImageData(canvas.width, canvas.height), pixels = new Uint32Array(image.data.buffer);
    counts.forEach((line, y) => {
        const [red, green, blue] = [1, 3, 5].map((k) => parseInt(colours[y].slice(k, k + 2), 16));
        const opaque = (blue << 16) | (green << 8) | red;
        for (let x = 0; x < line.length; ++x)
            if (line[x]) pixels[y * canvas.width + x] = ((minAlpha + (255 - minAlpha) * Math.sqrt(line[x] / max)) << 24) | opaque;
    });
    canvas.getContext("2d").putImageData(image, 0, 0);
    return canvas;
}
