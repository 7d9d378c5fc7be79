"use strict";
// The instantaneous frequency of each afferent on the selected channel.

const MARKS = ["●", "▲", "■", "◆"];

/// The instantaneous frequency f_k = 1 / (t[k+1] - t[k]) as a mark at spike time t[k]; the last spike has none.
class FrequencyPanel extends Panel {
    /// `trains`: [{name, color, index, spikes}]; `index` selects the shape of the marks.
    constructor({trains, title = "instantaneous frequency", ...rest}) {
        const highest = trains.reduce((high, {spikes}) => Math.max(high, spikes.frequency.range(0, spikes.count)[1] || 0), 0);
        const power = prefixPower(highest, "Hz");
        super({...rest, scale: 10 ** power, title: titleHtml(title, PREFIXES[power] + "Hz"), bottom: true,
               series: trains.map(({name, color, index}) => ({label: name, html: escaped(name), color, mark: MARKS[index % 4], index}))});
        Object.assign(this, {trains: trains.map((one) => one.spikes), highest});
    }

    options() {
        const series = Object.fromEntries(this.series.map(({label, color, index}) =>
            [label, {color, strokeWidth: 0, drawPoints: true, pointSize: 2.5, drawPointCallback: drawMark(index % 4)}]));
        return {series};
    }

    valueTicks(lo, hi, pixels) { return super.valueTicks(lo, hi, 1.35 * pixels); }

    range(rows) {
        const high = rows && rows.length ? this.trains.reduce((m, _, k) => Math.max(m, maximum(rows, k + 1)), 0) : this.highest;
        return [(high || 1) * -0.04, (high || 1) * 1.08];
    }

    /// The rows for dygraphs from time a to b: every mark if there are few, else two marks per pixel column. `width`: of the plot, pixels.
    rows(a, b, width) {
        const margin = 4 * devicePixels() * (b - a) / width;  // s; marks that the edge of the plot cuts are drawn, too
        const visible = this.trains.map((spikes) => [spikes.before(a - margin), Math.min(spikes.before(b + margin), spikes.count - 1)]);
        const total = visible.reduce((sum, [i, j]) => sum + Math.max(j - i, 0), 0);
        return total <= 2 * width ? this.everyMark(visible) : this.columnMarks(a, b, width);
    }

    /// `visible`: the indices [first, end) of the visible frequencies of each train.
    everyMark(visible) {
        const rows = [];
        this.trains.forEach((spikes, s) => {
            const f = spikes.frequency.levels[0].lo;
            for (let k = visible[s][0]; k < visible[s][1]; ++k) rows.push([spikes.times[k], ...this.trains.map((_, o) => (o === s ? f[k] : null))]);
        });
        return rows.sort((one, other) => one[0] - other[0]);
    }

    /// The minimum and maximum frequency of each train in each pixel column.
    columnMarks(a, b, width) {
        const rows = [], columns = Math.ceil(width), step = (b - a) / columns;
        let from = this.trains.map((spikes) => spikes.before(a));
        for (let c = 0; c < columns; ++c) {
            const to = this.trains.map((spikes) => spikes.before(a + (c + 1) * step));
            const ranges = this.trains.map((spikes, s) => spikes.frequency.range(from[s], to[s]));
            for (const end of [0, 1]) rows.push([a + (c + 0.5) * step, ...ranges.map((range) => range[end])]);
            from = to;
        }
        return rows;
    }

    /// Shows the frequency at the last spike before t.
    showValues(t) {
        this.trains.forEach((spikes, s) => {
            const k = spikes.before(t) - 1;
            this.values[s].textContent = k < 0 || k >= spikes.count - 1 ? "–" : quantity(spikes.frequency.range(k, k + 1)[0], "Hz");
        });
    }
}

/// A drawPointCallback of dygraphs. `kind`: 0 disc, 1 triangle, 2 square, 3 diamond, so that afferents differ in shape as well as in colour.
function drawMark(kind) {
    const corners = [null, [[0, -1.2], [1.1, 0.8], [-1.1, 0.8]], [[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]], [[0, -1.3], [1.3, 0], [0, 1.3], [-1.3, 0]]][kind];
    return (_chart, _series, context, x, y, color, size) => {
        context.fillStyle = color;
        context.beginPath();
        if (corners) corners.forEach(([dx, dy]) => context.lineTo(x + dx * size, y + dy * size));
        else context.arc(x, y, size, 0, 2 * Math.PI);
        context.fill();
    };
}
