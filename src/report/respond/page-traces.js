"use strict";
// Plots of force, currents and membranes over time, reduced to the resolution of the screen.

/// Traces of one unit over time. The unit of the axis has the SI prefix that suits the largest value.
class TracePanel extends Panel {
    /// `symbol`: the end of the title, such as "I_A". `line`: {value, html} of a level that is drawn dashed, such as the threshold; null for none.
    constructor({traces, line = null, title, symbol = "", ...rest}) {
        const extent = extentOf(traces.map((trace) => trace.fullRange()), line);
        const power = prefixPower(Math.max(Math.abs(extent[0]), Math.abs(extent[1])), traces[0].unit);
        const unit = PREFIXES[power] + unitText(traces[0].unit);
        super({...rest, scale: 10 ** power, title: escaped(title) + symbolHtml(symbol) + titleHtml("", unit)});
        Object.assign(this, {traces, line, extent});
        if (line) this.legend({html: line.html, color: colour("level"), width: 1, dash: [5, 3]}).textContent = quantity(line.value, traces[0].unit, true);
    }

    /// The rows for dygraphs from time a to b. `width`: of the plot, pixels. If there are few samples, a row is a sample. Otherwise each column
    /// of about one pixel has two rows, with the minimum and maximum of its samples. A column's first sample is a multiple of its number of
    /// samples, so that the plot does not flicker while it is panned.
    rows(a, b, width) {
        const {t0, T, samples} = this.traces[0];  // the same for all traces of an input
        const finest = Math.min(...this.traces.map((trace) => trace.bucket));
        const count = (b - a) / T;
        const single = finest === 1 && count <= 2 * width;
        // samples per column
        const column = single ? 1 : finest * Math.max(1, Math.ceil(count / (finest * width)));
        this.dots = single && count < width / (8 * devicePixels());
        const first = Math.max(0, Math.floor((a - t0) / T / column) - 1);
        const end = Math.min(Math.ceil(samples / column), Math.ceil((b - t0) / T / column) + 2);
        const rows = [], last = this.traces.map(() => 0);
        for (let c = first; c < end; ++c) {
            const t = t0 + (c * column + (column - 1) / 2) * T;
            const ranges = this.traces.map((trace) => trace.range(c * column, (c + 1) * column));
            if (single) rows.push([t, ...ranges.map((range) => range[0])]);
            else rows.push(...bothEnds(t, ranges, last));
        }
        return rows;
    }

    range(rows) {
        const extent = rows && rows.length ? extentOf(this.traces.map((_, k) => [minimum(rows, k + 1), maximum(rows, k + 1)]), null) : this.extent;
        return padded(extent, this.named ? 0.24 : 0.07);
    }

    drawBackground(context, area) {
        super.drawBackground(context, area);
        if (this.line) this.drawLine(context, area);
    }

    drawLine(context, area) {
        const y = Math.round(this.chart.toDomYCoord(this.line.value)) + 0.5;
        context.save();
        context.strokeStyle = colour("level");
        context.setLineDash([5, 3]);
        context.beginPath();
        context.moveTo(area.x, y);
        context.lineTo(area.x + area.w, y);
        context.stroke();
        context.restore();
    }

    showValues(t) {
        this.traces.forEach((trace, k) => { this.values[k].textContent = rangeText(trace.at(t), trace.unit); });
    }
}

/// One quantity of several implementations. The left axis is that of the reference. Implementations with another scale are read on the right
/// axis, which has the scale of the first of them.
class OverlayPanel extends TracePanel {
    /// `implementations`: [{trace, scale, color, name}].
    constructor({implementations, title, symbol, ...rest}) {
        const traces = implementations.map(({trace, scale}) => (scale.isIdentity ? trace : new ScaledTrace(trace, scale)));
        super({...rest, traces, title, symbol, series: implementations.map(({name, color}, k) => ({label: name, html: escaped(name), color, width: k ? 1.3 : 2.2}))});
        this.right = implementations.find(({scale}) => !scale.isIdentity);
        if (!this.right) return;
        const {scale, color, name, trace} = this.right;
        const power = prefixPower(Math.max(...this.extent.map((v) => Math.abs(scale.from(v)))), trace.unit);
        Object.assign(this, {rightScale: 10 ** power, rightMargin: isNarrow() ? 38 : 58});
        const inverted = scale.factor < 0 ? ", inverted" : "";
        element(this.heading, "span", "right-title", `${escaped(name)}${inverted} <span class="unit">(${PREFIXES[power]}${unitText(trace.unit)})</span>`).style.color = color;
    }

    start(view) {
        super.start(view);
        if (this.right) this.axis = element(this.plot, "div", "right-axis");
    }

    draw(a, b, autoscale) {
        super.draw(a, b, autoscale);
        if (this.right && this.area.w >= 1) this.drawRight(this.area);
    }

    /// These panels have little height, so their ticks are closer together.
    valueTicks(lo, hi, pixels) { return super.valueTicks(lo, hi, 1.4 * pixels); }

    /// Draws round values of the right axis at the corresponding heights of the left axis.
    drawRight({x, y, w, h}) {
        const {scale, color} = this.right, unit = this.rightScale;
        const ends = this.chart.yAxisRange().map((v) => scale.from(v) / unit);
        const {values, decimals} = roundTicks(Math.min(...ends), Math.max(...ends), h / 23);
        const label = (v) => `<span style="top: ${this.chart.toDomYCoord(scale.to(v * unit)) - y}px">${v.toFixed(decimals).replace("-", "−")}</span>`;
        Object.assign(this.axis.style, {left: `${x + w}px`, top: `${y}px`, height: `${h}px`, color});
        this.axis.innerHTML = values.map(label).join("");
    }
}

/// Two rows of a column at time t, for its minimum and maximum. For each trace, the one nearer to the previous point comes first, so that lines
/// with a slope stay thin. `last`: the previous value of each trace; updated.
function bothEnds(t, ranges, last) {
    const near = ranges.map(([low, high], k) => (Math.abs(last[k] - low) <= Math.abs(last[k] - high) ? 0 : 1));
    ranges.forEach((range, k) => { last[k] = range[1 - near[k]]; });
    return [[t, ...ranges.map((range, k) => range[near[k]])], [t, ...last]];
}

/// One value as text, or minimum and maximum if their texts differ.
function rangeText([low, high], unit) {
    const [first, second] = [quantity(low, unit), quantity(high, unit)];
    return first === second ? first : `${first} … ${second}`;
}

// The smallest and the largest value in a column of rows; null is ignored.
const minimum = (rows, column) => rows.reduce((low, row) => (row[column] !== null && row[column] < low ? row[column] : low), Infinity);
const maximum = (rows, column) => rows.reduce((high, row) => (row[column] !== null && row[column] > high ? row[column] : high), -Infinity);

/// [min, max] over ranges and the level of `line`, if there is one.
function extentOf(ranges, line) {
    const ends = [...ranges.flat(), line ? line.value : null].filter((v) => v !== null && Number.isFinite(v));
    return ends.length ? [Math.min(...ends), Math.max(...ends)] : [0, 0];
}

/// Adds margins to a vertical range. `above`: the upper margin as a fraction of the height, larger if names of phases are shown.
function padded([low, high], above) {
    const height = high - low || Math.abs(high) * 0.2 || 1;
    return [low - height * 0.07, high + height * above];
}
