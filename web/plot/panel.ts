// A panel is one plot with a heading, which is also the legend and shows the values at the cursor.

import {resolved} from "../base/colours";
import {Child, append, h, isNarrow, isWide, pixelRatio} from "../base/dom";
import {Ticks, fixedText, roundTicks} from "../base/text";
import {Pen, SvgPen} from "./pen";
import {connectPointer} from "./pointer";
import {saveMenu} from "./save-menu";
import type {View} from "./view";

export interface Area { x: number; y: number; w: number; h: number }
export interface Series { name: string; label?: Child[]; colour: string; width?: number; dash?: number[]; mark?: string }

export interface PanelOptions {
    host: Element;
    name: string;        ///< for links, files and tests: "sa1 membrane"
    title: Child[];
    about: string;       ///< for screen readers
    height: number;      ///< of the plot without its x axis, pixels
    series: Series[];
    isBottom?: boolean;  ///< label the x axis
}

const font = () => `${isWide() ? 14 : 11}px system-ui, sans-serif`;
const X_AXIS = 22, X_AXIS_WITHOUT_LABELS = 8;

/// Derived classes define what they draw, their vertical range, their values at the cursor and their numbers as CSV.
export abstract class Panel {
    readonly root: HTMLElement;
    readonly plot: HTMLElement;
    readonly name: string;
    readonly series: Series[];
    readonly hidden = new Set<string>();  // names of series that the legend has switched off
    area: Area = {x: 0, y: 0, w: 0, h: 0};
    leftMargin = 40;
    rightMargin = 14;
    height: number;
    isBottom: boolean;
    protected titleSpace = {top: 0, bottom: 0};  // for titles of the axes, pixels
    drawn = 0;  // points of the last drawing, for tests
    view!: View;
    protected values = new Map<string, HTMLElement>();
    protected low = 0;
    protected high = 1;
    protected readonly about: string;
    protected readonly heading: HTMLElement;
    protected readonly legend: HTMLElement;
    protected readonly canvas = h("canvas", {});
    private hairline = h("div", {class: "hairline"});
    private selection = h("div", {class: "selection"});
    private tip = h("div", {class: "tip", role: "status"});
    private ticks: Ticks = {values: [], text: String};

    constructor({host, name, title, about, height, series, isBottom = false}: PanelOptions) {
        [this.name, this.about, this.height, this.series, this.isBottom] = [name, about, height * (isWide() ? 1.4 : 1), series, isBottom];
        this.legend = h("span", {class: "legend"});
        this.heading = h("figcaption", {}, h("span", {class: "panel-title"}, ...title), this.legend, saveMenu(name, this.canvas, () => this.svg(), () => this.csv()));
        this.plot = h("div", {class: "plot", tabindex: 0, role: "img", "aria-label": about}, this.canvas, this.hairline, this.selection, this.tip);
        this.plot.addEventListener("keydown", (event) => {
            if (event.ctrlKey || event.altKey || event.metaKey || !this.key(event.key)) return;
            event.preventDefault();
            event.stopPropagation();
        });
        this.root = h("figure", {class: "panel", "data-panel": name}, this.heading, this.plot);
        host.append(this.root);
        for (const one of series) this.addLegendItem(one);
    }

    /// Draws the data between the axes. x() and y() give pixels; the drawing is clipped to `area`.
    protected abstract paint(pen: Pen, area: Area): void;
    /// The vertical range for the visible x, or for all x.
    protected abstract range(isAutoscale: boolean): [number, number];
    /// Writes the values at x into the legend with setValue().
    protected showValues(_x: number): void {}
    /// The numbers of the visible range as CSV, with a heading.
    abstract csv(): string;
    /// The ticks of the vertical axis.
    protected verticalTicks(low: number, high: number, pixels: number): Ticks { return roundTicks(low, high, pixels / 32); }
    protected horizontalTicks(a: number, b: number, pixels: number): Ticks { return roundTicks(a, b, pixels / (isNarrow() ? 80 : 110)); }
    /// The text of a tick of the x axis.
    protected horizontalText(text: string): string { return this.view.unit ? `${text} ${this.view.unit}` : text; }
    /// A text and its place for the point at (x, y) in pixels, or null. Shown beside the pointer.
    protected tipAt(_x: number, _y: number): {x: number; y: number; text: string} | null { return null; }
    /// Called for a click at a point of the plot, in pixels.
    click(_x: number, _y: number): void {}
    /// Called for a key while the plot has the focus. Returns true if the panel has used it.
    protected key(_key: string): boolean { return false; }
    /// Draws beside the axes, such as a second vertical axis.
    protected paintMargins(_pen: Pen, _area: Area): void {}

    connect(view: View) {
        this.view = view;
        connectPointer(this, view);
        new ResizeObserver(() => view.request()).observe(this.plot);
    }

    remove() { this.root.remove(); }
    get isShown() { return this.plot.clientWidth > 0; }

    x(value: number) { return this.area.x + (value - this.view.a) / (this.view.b - this.view.a) * this.area.w; }
    y(value: number) { return this.area.y + (this.high - value) / (this.high - this.low) * this.area.h; }
    /// The value of x at a pixel.
    valueAt(x: number) { return this.view.a + (x - this.area.x) / this.area.w * (this.view.b - this.view.a); }

    protected isVisible(one: Series) { return !this.hidden.has(one.name); }

    /// Adds an item to the legend: a button that hides its series, and the value at the cursor.
    protected addLegendItem({name, label = [name], colour, width = 1.5, dash, mark}: Series, canHide = true) {
        const swatch = mark ? h("span", {class: "mark", style: `color: ${colour}`}, mark)
            : h("span", {class: "swatch", style: `border-top: ${width}px ${dash ? (dash[0] > 3 ? "dashed" : "dotted") : "solid"} ${colour}`});
        const value = h("span", {class: "legend-value"});
        const item = canHide && this.series.length > 1
            ? h("button", {class: "legend-item", type: "button", "aria-pressed": "true", title: "Show or hide", "data-series": name, onclick: () => this.onToggle(name)}, swatch, h("span", {class: "legend-name"}, ...label), value)
            : h("span", {class: "legend-item", "data-series": name}, label.length ? swatch : null, h("span", {class: "legend-name"}, ...label), value);
        this.values.set(name, value);
        this.legend.append(item);
    }

    /// Called when the user clicks a series in the legend.
    onToggle: (name: string) => void = (name) => this.toggle(name);

    toggle(name: string) {
        if (!this.hidden.delete(name)) this.hidden.add(name);
        this.legend.querySelectorAll<HTMLElement>("button").forEach((item) => item.setAttribute("aria-pressed", String(!this.hidden.has(item.dataset.series!))));
        this.view.request();
    }

    protected setValue(name: string, text: string) {
        const value = this.values.get(name);
        if (value && value.textContent !== text) value.textContent = text;
    }

    /// Chooses the ticks and the margin that their labels need.
    layOut() {
        [this.low, this.high] = this.range(this.view.isAutoscale);
        this.ticks = this.verticalTicks(this.low, this.high, this.height);
        const pen = this.canvas.getContext("2d")!;
        pen.font = font();
        this.leftMargin = Math.ceil(Math.max(isNarrow() ? 24 : 44, ...this.ticks.values.map((v) => pen.measureText(this.ticks.text(v)).width + 9)));
    }

    /// Draws the panel with these margins, which are the same for all panels of a view.
    draw(left: number, right: number) {
        const width = this.plot.clientWidth, height = this.fullHeight, ratio = pixelRatio();
        this.root.style.setProperty("--left", `${left}px`);
        this.area = {x: left, y: 4 + this.titleSpace.top, w: Math.max(1, width - left - right), h: this.height - 4};
        if (this.canvas.width !== Math.round(width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
            [this.canvas.width, this.canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
            [this.canvas.style.width, this.canvas.style.height] = [`${width}px`, `${height}px`];
        }
        const pen = this.canvas.getContext("2d")!;
        pen.setTransform(ratio, 0, 0, ratio, 0, 0);
        pen.clearRect(0, 0, width, height);
        this.drawAll(pen);
        this.plot.setAttribute("aria-label", `${this.about}, ${this.spanText()}`);
    }

    private get fullHeight() { return this.height + this.titleSpace.top + this.titleSpace.bottom + (this.isBottom ? X_AXIS : X_AXIS_WITHOUT_LABELS); }

    /// The visible range of x, for screen readers.
    protected spanText(): string {
        const {a, b, unit} = this.view, step = (b - a) / 1000;
        return `from ${fixedText(a, step, unit)} to ${fixedText(b, step, unit)}`;
    }

    private drawAll(pen: Pen) {
        const {area} = this, {x, y, w} = area;
        pen.font = font();
        pen.lineJoin = "bevel";  // mitred peaks would exceed the values
        this.drawGrid(pen);
        pen.save();
        pen.beginPath();
        pen.rect(x, y, w, area.h);
        pen.clip();
        this.paint(pen, area);
        pen.restore();
        this.paintMargins(pen, area);
        pen.strokeStyle = resolved("var(--axis)");
        pen.lineWidth = 1;
        pen.beginPath();
        pen.moveTo(x + 0.5, y);
        pen.lineTo(x + 0.5, y + area.h + 0.5);
        pen.lineTo(x + w, y + area.h + 0.5);
        pen.stroke();
    }

    private drawGrid(pen: Pen) {
        const {x, y, w, h: height} = this.area, ticks = this.horizontalTicks(this.view.a, this.view.b, w);
        const line = (x1: number, y1: number, x2: number, y2: number) => { pen.moveTo(x1, y1); pen.lineTo(x2, y2); };
        pen.strokeStyle = resolved("var(--grid)");
        pen.lineWidth = 1;
        pen.beginPath();
        for (const v of this.ticks.values) line(x, Math.round(this.y(v)) + 0.5, x + w, Math.round(this.y(v)) + 0.5);
        for (const v of ticks.values) line(Math.round(this.x(v)) + 0.5, y, Math.round(this.x(v)) + 0.5, y + height);
        pen.stroke();
        pen.fillStyle = resolved("var(--faint)");
        pen.textBaseline = "middle";
        pen.textAlign = "right";
        for (const v of this.ticks.values) pen.fillText(this.ticks.text(v), x - 5, Math.min(Math.max(this.y(v), y + 5), y + height - 3));
        pen.textBaseline = "top";
        pen.textAlign = "center";
        for (const v of this.isBottom ? ticks.values : []) {
            const text = this.horizontalText(ticks.text(v)), half = pen.measureText(text).width / 2;
            pen.fillText(text, Math.max(half, Math.min(x + w + this.rightMargin - half, this.x(v))), y + height + 6);
        }
        pen.textBaseline = "alphabetic";
    }

    showCursor(x: number | null) {
        const isInside = x !== null && x >= this.view.a && x <= this.view.b;
        this.hairline.style.display = isInside ? "block" : "none";
        if (isInside) this.hairline.style.transform = `translateX(${this.x(x)}px)`;
        this.hairline.style.height = `${this.area.y + this.area.h}px`;
        if (x !== null) this.showValues(x);
        else this.clearValues();
    }

    protected clearValues() { this.values.forEach((value) => { value.textContent = ""; }); }

    /// Marks the part between two pixels that a drag selects.
    showSelection(from: number, to: number) {
        Object.assign(this.selection.style, {display: from === to ? "none" : "block", left: `${Math.min(from, to)}px`, width: `${Math.abs(to - from)}px`, height: `${this.area.y + this.area.h}px`});
    }

    /// Shows the tip of the point at (x, y); negative coordinates hide it.
    hover(x: number, y: number) {
        const tip = x < 0 ? null : this.tipAt(x, y);
        this.tip.style.display = tip ? "block" : "none";
        if (!tip) return;
        this.tip.textContent = tip.text;
        const left = Math.min(tip.x + 10, this.plot.clientWidth - this.tip.offsetWidth - 4);
        Object.assign(this.tip.style, {left: `${Math.max(0, left)}px`, top: `${Math.max(0, tip.y - this.tip.offsetHeight - 8)}px`});
    }

    /// The drawing as an SVG file.
    svg(): string {
        const pen = new SvgPen(), width = this.plot.clientWidth, height = this.fullHeight;
        pen.fillStyle = resolved("var(--paper)");
        pen.fillRect(0, 0, width, height);
        this.drawAll(pen);
        return pen.text(width, height, this.about);
    }

    protected addTitle(...parts: Child[]) { append(this.heading.querySelector(".panel-title")!, ...parts); }
}

/// Numbers as CSV: a heading, then rows. Texts with commas or quotes are quoted.
export function csvText(heading: string[], rows: Iterable<(string | number | null)[]>): string {
    const field = (value: string | number | null) => (value === null ? "" : typeof value === "string" && /[",\n]/.test(value) ? `"${value.replace(/"/g, '""')}"` : String(value));
    return [heading, ...rows].map((row) => row.map(field).join(",") + "\n").join("");
}
