"use strict";
// Plots over time beneath the maps: how often each class fires, and the spikes of its units.

/// Rates of classes, in bins that are as wide as about 100 of them fill the window: of the units that fire at some time, for the others
/// were not touched.
class SkinRatePanel extends PopulationPanel {
    /// `fine`: {frames, classes}: spikes of each class in narrow bins.
    constructor({fine, ...rest}) {
        super({...rest, each: "unit", rates: SkinRatePanel.binned(fine, rest.input, fine.frames.count * fine.frames.width)});
        this.fine = fine;
    }

    titleOf() { return titleHtml(`mean rate of the units that fire, in bins of ${quantity(this.rates[0].bin, "s", true)}`, this.unit); }

    /// For a window of so many seconds.
    static binned({frames, classes}, input, span) {
        const join = 2 ** Math.max(0, Math.round(Math.log2(span / 100 / frames.width))), bins = Math.ceil(frames.count / join), bin = join * frames.width;
        const counts = classes.map(() => new Float64Array(bins));
        for (let f = 0; f < frames.count; ++f) frames.each(f, (c, n) => { counts[c][Math.floor(f / join)] += n; });
        const length = (k) => Math.min(bin, input.samples * input.T - k * bin) || bin;
        return classes.map(({name, color, index, active}) => ({name, color, index, bin, values: Array.from(counts[index], (n, k) => n / Math.max(1, active) / length(k))}));
    }

    draw(a, b, fit) {
        this.rates = SkinRatePanel.binned(this.fine, this.input, b - a);
        this.highest = this.rates.reduce((high, {values}) => values.reduce((m, v) => Math.max(m, v), high), 0);
        this.heading.querySelector(".panel-title").innerHTML = this.titleOf();
        super.draw(a, b, fit);
    }
}

/// Units of one class that fired, in their order on the skin: a mark for each spike while they stand apart, else how many share a pixel.
class SkinRasterPanel extends Panel {
    /// `trains`: as Trains.train() gives them; `told`: how many units these are; `pointed(unit)` hears who is pointed at.
    constructor({one, trains, told, pointed, ...rest}) {
        super({...rest, title: `<span class="chip" style="background: ${one.color}"></span>${escaped(one.name)} spikes <span class="unit">${escaped(told)}; neighbours stand together</span>`,
               series: [{label: one.name, html: "", color: one.color, width: 3}]});
        Object.assign(this, {one, trains, pointed});
    }

    rows() { return []; }
    options() { return {drawGrid: false}; }
    read() {}
    forget() {}
    range() { return [0, Math.max(1, this.trains.length)]; }
    valueTicks() { return [{v: Math.max(1, this.trains.length) / 2, label: escaped(this.one.name)}]; }

    start(view) {
        super.start(view);
        this.plot.addEventListener("pointermove", (event) => this.pointAt(event.clientY - this.plot.getBoundingClientRect().top));
        this.plot.addEventListener("pointerleave", () => this.pointed(null));
    }

    pointAt(y) {
        const row = Math.floor((y - this.area.y) / this.area.h * this.trains.length);
        this.pointed(this.trains[row] ? this.trains[row].unit : null);
    }

    under(context, area) {
        super.under(context, area);
        const [a, b] = this.chart.xAxisRange();
        const seen = this.trains.map((train) => [train.before(a), train.before(b)]);
        const all = seen.reduce((sum, [i, j]) => sum + j - i, 0), total = this.trains.reduce((sum, {times}) => sum + times.length, 0);
        const tall = area.h / Math.max(1, this.trains.length);
        this.marked = tall >= 1.5 && all < 20000 && all < area.w * area.h / 12;
        if (this.marked) this.drawMarks(context, area, seen, tall);
        else if (this.trains.length) this.drawShades(context, area, a, b, seen);
        this.values[0].textContent = all === total ? `${total}` : `${all} of ${total}`;
    }

    drawMarks(context, area, seen, tall) {
        context.fillStyle = this.one.color;
        this.trains.forEach(({times}, k) => {
            for (let i = seen[k][0]; i < seen[k][1]; ++i) context.fillRect(this.chart.toDomXCoord(times[i]) - 0.75, area.y + k * tall, 1.5, Math.max(1, tall * 0.85));
        });
    }

    drawShades(context, area, a, b, seen) {
        const all = seen.reduce((sum, [i, j]) => sum + j - i, 0), wide = all < area.w * area.h / 40 ? 1.6 : 1;  // few are drawn wider, to be seen
        const [columns, lines] = [Math.round(area.w * ratioOf() / wide), Math.min(this.trains.length, Math.floor(area.h * ratioOf()))];
        const counts = Array.from({length: lines}, () => new Uint32Array(columns));
        this.trains.forEach((train, k) => countPerColumn(counts[Math.floor(k * lines / this.trains.length)], train, ...seen[k], a, b));
        stretched(context, area, counts, this.one.color);
    }
}

const ratioOf = () => devicePixelRatio || 1;

/// One pixel a line and column, over the whole plot.
function stretched(context, area, counts, color) {
    context.imageSmoothingEnabled = false;
    context.drawImage(painted(counts, counts.map(() => color), 110), area.x, area.y, area.w, area.h);
}

/// The same of more spikes than the page carries: how many in each frame of the maps.
class SkinShadePanel extends SkinRasterPanel {
    /// `rows`: marks that fired; `frames` their spikes.
    constructor({frames, t0, rowOf, rowCount, ...rest}) {
        super({...rest, trains: []});
        Object.assign(this, {frames, t0, rowOf, rowCount});
    }

    range() { return [0, Math.max(1, this.rowCount)]; }
    valueTicks() { return [{v: Math.max(1, this.rowCount) / 2, label: escaped(this.one.name)}]; }
    pointAt() {}

    under(context, area) {
        Panel.prototype.under.call(this, context, area);
        if (!this.rowCount) return;
        const [a, b] = this.chart.xAxisRange(), columns = Math.round(area.w * ratioOf()), lines = Math.min(this.rowCount, Math.floor(area.h * ratioOf()));
        const counts = Array.from({length: lines}, () => new Float64Array(columns)), {width, count} = this.frames;
        const column = (t) => Math.max(0, Math.min(columns, Math.round((t - a) / (b - a) * columns)));
        for (let f = 0; f < count; ++f) {
            const [from, to] = [column(this.t0 + f * width), column(this.t0 + (f + 1) * width)];
            if (from >= to) continue;
            this.frames.each(f, (mark, n) => {
                if (this.rowOf[mark] < 0) return;
                const line = counts[Math.floor(this.rowOf[mark] * lines / this.rowCount)];
                for (let c = from; c < to; ++c) line[c] += n / (to - from);
            });
        }
        stretched(context, area, counts, this.one.color);
    }
}
