"use strict";
// The plots over time below the maps: the mean rate of each class, and a raster of its afferents.

/// Firing rates of the classes in about 100 bins over the visible time range, each the mean over those afferents of the class that fire at least
/// once in the recording. Afferents far from the touched area would lower it.
class SkinRatePanel extends PopulationPanel {
    /// `fine`: {frames, classes}, where `frames` are the spike counts of the classes in narrow bins.
    constructor({fine, ...rest}) {
        super({...rest, noun: "afferent", rates: SkinRatePanel.binned(fine, rest.input, fine.frames.count * fine.frames.width)});
        this.fine = fine;
    }

    titleOf() { return titleHtml(`mean rate of afferents that fire, in bins of ${quantity(this.rates[0].bin, "s", true)}`, this.unit); }

    /// Rates (Hz) of the classes, for which narrow bins are merged so that `span` seconds have about 100 bins. The last bin may be shorter.
    static binned({frames, classes}, input, span) {
        const join = 2 ** Math.max(0, Math.round(Math.log2(span / 100 / frames.width))), bins = Math.ceil(frames.count / join), bin = join * frames.width;
        const counts = classes.map(() => new Float64Array(bins));
        for (let f = 0; f < frames.count; ++f) frames.each(f, (c, n) => { counts[c][Math.floor(f / join)] += n; });
        const length = (k) => Math.min(bin, input.samples * input.T - k * bin) || bin;
        return classes.map(({name, color, index, active}) => ({name, color, index, bin, values: Array.from(counts[index], (n, k) => n / Math.max(1, active) / length(k))}));
    }

    draw(a, b, autoscale) {
        this.rates = SkinRatePanel.binned(this.fine, this.input, b - a);
        this.highest = this.rates.reduce((high, {values}) => values.reduce((m, v) => Math.max(m, v), high), 0);
        this.heading.querySelector(".panel-title").innerHTML = this.titleOf();
        super.draw(a, b, autoscale);
    }
}

/// Raster of those afferents of one class that fired; neighbours on the skin are in adjacent rows. Each spike is a tick if there is space, else the
/// number of spikes per pixel is shown as shades.
class SkinRasterPanel extends Panel {
    /// `trains`: one per row, from Trains.train(). `countText`: a text with the number of afferents, for the title. `onPoint(afferent)` is called
    /// with the index of the afferent under the pointer, or null.
    constructor({skinClass, trains, countText, onPoint, ...rest}) {
        super({...rest, title: `<span class="chip" style="background: ${skinClass.color}"></span>${escaped(skinClass.name)} spikes <span class="unit">${escaped(countText)}; neighbours are adjacent</span>`,
               series: [{label: skinClass.name, html: "", color: skinClass.color, width: 3}]});
        Object.assign(this, {skinClass, trains, onPoint});
    }

    rows() { return []; }
    options() { return {drawGrid: false}; }
    showValues() {}
    clearValues() {}
    range() { return [0, Math.max(1, this.trains.length)]; }
    valueTicks() { return [{v: Math.max(1, this.trains.length) / 2, label: escaped(this.skinClass.name)}]; }

    start(view) {
        super.start(view);
        this.plot.addEventListener("pointermove", (event) => this.pointAt(event.clientY - this.plot.getBoundingClientRect().top));
        this.plot.addEventListener("pointerleave", () => this.onPoint(null));
    }

    pointAt(y) {
        const row = Math.floor((y - this.area.y) / this.area.h * this.trains.length);
        this.onPoint(this.trains[row] ? this.trains[row].afferent : null);
    }

    drawBackground(context, area) {
        super.drawBackground(context, area);
        const [a, b] = this.chart.xAxisRange();
        const visible = this.trains.map((train) => [train.before(a), train.before(b)]);
        const visibleCount = visible.reduce((sum, [i, j]) => sum + j - i, 0), total = this.trains.reduce((sum, {times}) => sum + times.length, 0);
        const rowHeight = area.h / Math.max(1, this.trains.length);
        this.marked = rowHeight >= 1.5 && visibleCount < 20000 && visibleCount < area.w * area.h / 12;
        if (this.marked) this.drawMarks(context, area, visible, rowHeight);
        else if (this.trains.length) this.drawShades(context, area, a, b, visible);
        this.values[0].textContent = visibleCount === total ? `${total}` : `${visibleCount} of ${total}`;
    }

    drawMarks(context, area, visible, rowHeight) {
        context.fillStyle = this.skinClass.color;
        this.trains.forEach(({times}, k) => {
            for (let i = visible[k][0]; i < visible[k][1]; ++i) context.fillRect(this.chart.toDomXCoord(times[i]) - 0.75, area.y + k * rowHeight, 1.5, Math.max(1, rowHeight * 0.85));
        });
    }

    drawShades(context, area, a, b, visible) {
        const visibleCount = visible.reduce((sum, [i, j]) => sum + j - i, 0), wide = visibleCount < area.w * area.h / 40 ? 1.6 : 1;  // few spikes are drawn wider, so that they are visible
        const [columns, lines] = [Math.round(area.w * ratioOf() / wide), Math.min(this.trains.length, Math.floor(area.h * ratioOf()))];
        const counts = Array.from({length: lines}, () => new Uint32Array(columns));
        this.trains.forEach((train, k) => countPerColumn(counts[Math.floor(k * lines / this.trains.length)], train, ...visible[k], a, b));
        drawScaled(context, area, counts, this.skinClass.color);
    }
}

/// Pixels of the screen per CSS pixel.
const ratioOf = () => devicePixelRatio || 1;

/// Draws spike counts as an image with one pixel per line and column, scaled to the plot.
function drawScaled(context, area, counts, color) {
    context.imageSmoothingEnabled = false;
    context.drawImage(painted(counts, counts.map(() => color), 110), area.x, area.y, area.w, area.h);
}

/// The raster if there are more spikes than the page contains the times of. A row is a mark, and it shows the mark's spike count in each frame of
/// the maps.
class SkinShadePanel extends SkinRasterPanel {
    /// `frames`: spike counts of the marks. `rowOf`: the row of each mark, from 0; -1 for a mark that is not shown.
    constructor({frames, t0, rowOf, rowCount, ...rest}) {
        super({...rest, trains: []});
        Object.assign(this, {frames, t0, rowOf, rowCount});
    }

    range() { return [0, Math.max(1, this.rowCount)]; }
    valueTicks() { return [{v: Math.max(1, this.rowCount) / 2, label: escaped(this.skinClass.name)}]; }
    pointAt() {}

    drawBackground(context, area) {
        Panel.prototype.drawBackground.call(this, context, area);
        if (!this.rowCount) return;
        const [a, b] = this.chart.xAxisRange(), columns = Math.round(area.w * ratioOf()), lines = Math.min(this.rowCount, Math.floor(area.h * ratioOf()));
        const counts = Array.from({length: lines}, () => new Float64Array(columns)), {width, count} = this.frames;
        const column = (t) => Math.max(0, Math.min(columns, Math.round((t - a) / (b - a) * columns)));
        for (let f = 0; f < count; ++f) {
            const [from, to] = [column(this.t0 + f * width), column(this.t0 + (f + 1) * width)];
            if (from >= to) continue;  // not visible
            // A frame is as wide as columns `from` to `to` - 1, among which its counts are divided.
            this.frames.each(f, (mark, n) => {
                if (this.rowOf[mark] < 0) return;
                const line = counts[Math.floor(this.rowOf[mark] * lines / this.rowCount)];
                for (let c = from; c < to; ++c) line[c] += n / (to - from);
            });
        }
        drawScaled(context, area, counts, this.skinClass.color);
    }
}
