"use strict";
// A panel is one dygraph with a heading, which is also the legend and shows the values at the cursor. All panels have the same left edge
// and width, so that times align.

const AXIS_FONT = 11;  // pixels

/// Colours are defined in the style sheet, for light and dark themes.
const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
const afferentColour = (index) => colour("series-" + index % 8);

/// Pixels of the screen or of paper per CSS pixel.
const devicePixels = () => (document.documentElement.classList.contains("printing") ? 2 : window.devicePixelRatio || 1);

/// True on the screen of a phone: plots then have narrower margins.
const isNarrow = () => document.documentElement.clientWidth < 520;

/// Mixes two #rrggbb colours: fraction 0 is the first, 1 the second.
function mixed(first, second, fraction) {
    const component = (text, k) => parseInt(text.slice(1 + 2 * k, 3 + 2 * k), 16);
    return "#" + [0, 1, 2].map((k) => Math.round(component(first, k) * (1 - fraction) + component(second, k) * fraction).toString(16).padStart(2, "0")).join("");
}

function element(parent, tag, className = "", html = "") {
    const node = document.createElement(tag);
    if (className) node.className = className;
    if (html) node.innerHTML = html;
    if (parent) parent.append(node);
    return node;
}

class Panel {
    /// `series`: [{label, html, color, width, dash}], one for each column of rows() after the time. `scale`: the value that the axis labels 1
    /// (1e-3 for mV). `height`: of the plot without its time axis, pixels. `bottom`: label the time axis. `named`: show the names of the phases.
    /// Derived classes define rows(a, b, width), range(rows), the vertical range, and showValues(t), which writes values into the legend.
    constructor({host, input, name, title, about, height, series, scale = 1, bottom = false, named = false}) {
        Object.assign(this, {input, name, series, about, height, scale, named, axisHeight: bottom ? 22 : 16, bottom, dots: false, rightMargin: 14});
        this.root = element(host, "figure", "panel");
        this.root.dataset.panel = name;
        this.heading = element(this.root, "figcaption");
        element(this.heading, "span", "panel-title", title);
        this.plot = element(this.root, "div", "plot");
        this.plot.style.height = height + this.axisHeight + "px";
        this.plot.setAttribute("role", "img");
        this.values = series.map((one) => this.legend(one));
    }

    /// Adds an item to the legend. Returns the element for its value.
    legend({label, html, color, width = 1.5, dash, mark}) {
        const item = element(this.heading, "span", "legend-item");
        if (label) item.dataset.series = label;
        const swatch = element(item, "span", mark ? "mark" : "swatch", mark || "");
        if (mark) swatch.style.color = color;
        else swatch.style.borderTop = `${width}px ${dash ? (dash[0] > 3 ? "dashed" : "dotted") : "solid"} ${color}`;
        element(item, "span", "legend-name", html);
        return element(item, "span", "legend-value");
    }

    /// Called when the panel is part of the page and its width is known.
    start(view) {
        this.chart = new Dygraph(this.plot, this.empty(view.a, view.b), {
            labels: ["t", ...this.series.map((one) => one.label)],
            series: Object.fromEntries(this.series.map((one) => [one.label, {color: one.color, strokeWidth: one.width, strokePattern: one.dash || null}])),
            dateWindow: [view.a, view.b],
            valueRange: this.range(null),
            axes: {
                x: {ticker: (lo, hi, pixels) => timeTicks(lo, hi, pixels, this.bottom), axisLabelWidth: isNarrow() ? 52 : 90},
                y: {ticker: (lo, hi, pixels) => this.valueTicks(lo, hi, pixels), axisLabelWidth: view.labelWidth},
            },
            underlayCallback: (context, area, chart) => {
                this.chart = chart;  // the first draw happens before the constructor returns
                if (area.w >= 1) this.drawBackground(context, area);  // a hidden page has no width
            },
            interactionModel: {},  // the view handles the mouse for all panels
            pixelRatio: devicePixels(),
            legend: "never", pointSize: 2.2, highlightCircleSize: 0, showLabelsOnHighlight: false,
            axisLabelFontSize: AXIS_FONT, axisTickSize: 3, rightGap: view.rightMargin, xAxisHeight: this.axisHeight,
            gridLineColor: colour("grid"), gridLineWidth: 1, axisLineColor: colour("axis"), axisLineWidth: 1,
            ...this.options(),
        });
        this.hairline = element(this.plot, "div", "hairline");
        this.selection = element(this.plot, "div", "selection");
    }

    /// Labels the time axis of this panel. Call it before start().
    showTimes() {
        Object.assign(this, {bottom: true, axisHeight: 22});
        this.plot.style.height = this.height + this.axisHeight + "px";
    }

    /// Further options of dygraphs.
    options() { return {}; }
    /// Called for a click at a point of the plot, in pixels.
    click() {}
    clearValues() { this.values.forEach((value) => { value.textContent = ""; }); }
    /// Rows without values: dygraphs then draws the axes only.
    empty(a, b) { return [a, b].map((t) => [t, ...this.series.map(() => null)]); }
    get area() { return this.chart.getArea(); }

    /// Draws the times from a to b. `autoscale`: fit the vertical axis to the visible data, else to all data.
    draw(a, b, autoscale) {
        if (this.area.w < 1) return;
        const rows = this.rows(a, b, this.area.w * devicePixels());
        this.chart.updateOptions({file: rows.length ? rows : this.empty(a, b), dateWindow: [a, b],
                                  valueRange: this.range(autoscale ? rows : null), drawPoints: this.dots});
        this.plot.setAttribute("aria-label", `${this.about}, from ${timeText(a, (b - a) / 1000)} to ${timeText(b, (b - a) / 1000)}`);
    }

    valueTicks(lo, hi, pixels) {
        const {values, decimals} = roundTicks(lo / this.scale, hi / this.scale, pixels / 32);
        return values.map((v) => ({v: v * this.scale, label: v.toFixed(decimals).replace("-", "−")}));
    }

    drawBackground(context, area) {
        context.lineJoin = "bevel";  // mitred peaks would exceed the values
        const x = (t) => Math.max(area.x, Math.min(area.x + area.w, this.chart.toDomXCoord(t)));
        this.input.phases.forEach(({name, from, to}, k) => {
            const [left, right] = [x(from), x(to)];
            context.fillStyle = colour("band");
            if (k % 2) context.fillRect(left, area.y, right - left, area.h);
            if (this.named) writeInside(context, name, left, right, area.y + 12);
        });
    }

    destroy() {
        this.chart.destroy();
        this.root.remove();
    }
}

/// Writes a text centred between two x coordinates, if it fits.
function writeInside(context, text, left, right, y) {
    context.font = `${AXIS_FONT}px system-ui, sans-serif`;
    context.textAlign = "center";
    context.fillStyle = colour("faint");
    if (context.measureText(text).width + 6 < right - left) context.fillText(text, (left + right) / 2, y);
}

/// Ticks of the time axis. `labelled`: with labels, which the last panel of a section has. dygraphs does not draw a tick exactly at the end,
/// so such a tick is moved slightly inwards.
function timeTicks(a, b, pixels, labelled) {
    const {values, decimals} = roundTicks(a, b, pixels / 110);
    return values.map((v) => ({v: Math.min(v, b - 1e-9 * (b - a)), label: labelled ? v.toFixed(decimals).replace("-", "−") + " s" : undefined}));
}
