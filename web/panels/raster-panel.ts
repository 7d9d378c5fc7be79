// Spikes of many afferents: one row each. The effort depends on the number of pixels, not of spikes.

import {components, resolved} from "../base/colours";
import {h, pixelRatio} from "../base/dom";
import {fixedText, quantity, Ticks} from "../base/text";
import {Area, csvText} from "../plot/panel";
import type {Pen} from "../plot/pen";
import type {Train} from "./signals";
import {PanelRow, RowsOptions, RowsPanel} from "./rows-panel";

const STRIP = 16;            // above the rows, for the names of the phases, pixels
const LABEL = 11;            // height of a label, pixels
const MAX_STEP = 3;          // if fewer rows than one in so many have space for a label, each series has one label

/// `series`: name of the series to which the row belongs.
export interface Row extends PanelRow { series: string; colour: string; spikes: Train; group?: string }

/// `isGrouped`: tint the chosen rows, and draw a line where the group of the rows changes.
export interface RasterOptions<R extends Row = Row> extends RowsOptions<R> { isGrouped?: boolean }

/// The height in pixels that suits a number of rows, at most `limit`.
export const rasterHeight = (rows: number, limit = 560) => Math.max(40, Math.min(24, limit / Math.max(rows, 1)) * rows);

/// Spikes are ticks if they and their rows can be distinguished, else the number of spikes per pixel is shown as shades.
export class RasterPanel<R extends Row = Row> extends RowsPanel<R> {
    private isGrouped: boolean;
    private image?: HTMLCanvasElement;  // of the last density

    constructor(options: RasterOptions<R>) {
        super({...options, about: `${options.about}; n and p move to the next and the previous spike`});
        this.isGrouped = options.isGrouped || false;
        if (this.isNamed) [this.strip, this.height] = [STRIP, this.height + STRIP];
    }

    protected get shownRows() { return this.rows.filter(({series}) => !this.hidden.has(series)); }

    /// A label for each row if there is space, else for one row in a few, else one for each series in the middle of its rows.
    protected verticalTicks(): Ticks {
        const rows = this.shownRows, n = rows.length, labels = new Map<number, string>();
        const step = Math.ceil(LABEL * n / (this.height - this.strip));
        if (step <= MAX_STEP) rows.forEach(({label}, k) => k % step === step >> 1 && labels.set(n - k - 0.5, label));
        else for (const {name} of this.series) {
            const own = rows.map(({series}, k) => (series === name ? k : -1)).filter((k) => k >= 0);
            if (own.length) labels.set(n - (own[0] + own[own.length - 1] + 1) / 2, name);
        }
        return {values: [...labels.keys()], text: (v) => labels.get(v) || ""};
    }

    protected paint(pen: Pen, area: Area) {
        super.paint(pen, area);
        const rows = this.shownRows, inner = this.inner(area), {a, b} = this.view;
        const visible = rows.map(({spikes}) => [spikes.before(a), spikes.before(b)] as [number, number]);
        const most = visible.reduce((max, [i, j]) => Math.max(max, j - i), 0), total = visible.reduce((sum, [i, j]) => sum + j - i, 0);
        this.markRows(pen, inner, rows);
        const areDistinct = rows.length < 2 * inner.h * pixelRatio();
        if (areDistinct && most * 4 < area.w && total < 20000) this.paintTicks(pen, inner, rows, visible);
        else if (rows.length) this.paintDensity(pen, inner, rows, visible, total < 20000 ? 150 : undefined);
        this.drawn = Math.min(total, 20000);
        this.paintCurrent(pen, inner);
        this.countSpikes(rows, visible);
    }

    /// Tints the chosen rows and draws a line between groups.
    private markRows(pen: Pen, area: Area, rows: Row[]) {
        if (!this.isGrouped) return;
        const height = area.h / rows.length, y = (k: number) => area.y + k * height;
        pen.fillStyle = resolved("var(--chosen)");
        if (this.pick) rows.forEach((row, k) => row.isChosen && pen.fillRect(area.x, y(k), area.w, Math.max(height, 2)));
        pen.fillStyle = resolved("var(--rule)");
        rows.forEach((row, k) => k && row.group !== rows[k - 1].group && pen.fillRect(area.x, Math.round(y(k)), area.w, 1));
    }

    private paintTicks(pen: Pen, area: Area, rows: Row[], visible: [number, number][]) {
        const height = area.h / rows.length, gap = height > 4 ? height * 0.12 : 0;
        rows.forEach(({spikes, colour}, k) => {
            pen.fillStyle = resolved(colour);
            for (let i = visible[k][0]; i < visible[k][1]; ++i) pen.fillRect(this.x(spikes.times[i]) - 0.75, area.y + k * height + gap, 1.5, Math.max(1, height - 2 * gap));
        });
    }

    /// Paints an image with one pixel per line and column, then scales it to the plot. A line is one row, or several if rows are thinner than a
    /// pixel of the screen.
    private paintDensity(pen: Pen, area: Area, rows: Row[], visible: [number, number][], minAlpha?: number) {
        const ratio = pixelRatio(), columns = Math.max(1, Math.round(area.w * ratio)), lines = Math.min(rows.length, Math.max(1, Math.floor(area.h * ratio)));
        const counts = new Uint32Array(lines * columns), colours: string[] = [];
        rows.forEach(({spikes, colour}, k) => {
            const line = Math.floor(k * lines / rows.length);
            countPerColumn(counts.subarray(line * columns, (line + 1) * columns), spikes, ...visible[k], this.view.a, this.view.b);
            colours[line] = colour;
        });
        const image = (this.image = painted(counts, colours, minAlpha, this.image)), gap = area.h / rows.length > 6 ? 1 : 0;
        pen.imageSmoothingEnabled = false;
        if (gap === 0) pen.drawImage(image, 0, 0, columns, lines, area.x, area.y, area.w, area.h);
        else for (let k = 0; k < lines; ++k) pen.drawImage(image, 0, k, columns, 1, area.x, area.y + k * area.h / lines + gap, area.w, area.h / lines - 2 * gap);
    }

    /// Shows in the legend how many spikes of the chosen rows of each series are visible.
    private countSpikes(rows: Row[], visible: [number, number][]) {
        for (const {name} of this.series) {
            let shown = 0, total = 0;
            rows.forEach(({series, isChosen = true, spikes}, k) => {
                if (series === name && isChosen) [shown, total] = [shown + visible[k][1] - visible[k][0], total + spikes.count];
            });
            this.setValue(name, shown === total ? `${total}` : `${shown} of ${total}`);
        }
    }

    protected clearValues() {}

    /// The spike nearest to the pointer, within 6 pixels: its time and the interval to the spike before.
    protected tipOf({spikes, about, label}: R, x: number, y: number) {
        const k = spikes.nearest(this.valueAt(x)), t = spikes.times[k], name = about || label;
        if (k < 0 || Math.abs(this.x(t) - x) > 6) return {x, y, text: name};
        const interval = k > 0 ? `, ${quantity(t - spikes.times[k - 1], "s")} after the one before` : "";
        const number = k + 1 + spikes.count - spikes.times.length;  // a live train forgets its first spikes
        return {x: this.x(t), y, text: `${name}: spike ${number} of ${spikes.count} at ${fixedText(t, 1e-6)}${interval}`};
    }

    /// n and p move the cursor to the next and the previous spike of the row that the keys have reached.
    protected key(name: string) {
        const step = {n: 1, p: -1}[name];
        if (!step || !this.shownRows.length) return super.key(name);
        const {spikes} = this.reachedRow(), {view} = this, from = view.cursor ?? (step > 0 ? view.a : view.b), k = spikes.before(from);
        const t = spikes.times[step < 0 ? k - 1 : spikes.times[k] === view.cursor ? k + 1 : k], half = (view.b - view.a) / 2;
        if (t === undefined) return true;
        if (t < view.a || t > view.b) view.set(t - half, t + half);
        view.point(t);
        this.hover(this.x(t), this.middleOfReached());
        view.request();
        return true;
    }

    csv() {
        const rows = this.shownRows.flatMap(({series, about, label, spikes}) => Array.from(spikes.times).slice(spikes.before(this.view.a), spikes.before(this.view.b)).map((t) => [series, about || label, t]));
        return csvText(["afferent", "row", "time_s"], rows);
    }
}

/// Adds spikes i ... j-1 of a train to the counts of the pixel columns that divide the time range [a, b) equally. Few spikes are counted one by
/// one; if there are many, the first spike of each column is found by binary search.
export function countPerColumn(counts: Uint32Array, spikes: Pick<Train, "times" | "before">, i: number, j: number, a: number, b: number) {
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

/// A canvas with one pixel per count and one line per colour, on `canvas` if it is given: more spikes are more opaque, and one spike has at least
/// the opacity `minAlpha` of 255.
export function painted(counts: Uint32Array, colours: string[], minAlpha = 55, canvas = h("canvas")): HTMLCanvasElement {
    const columns = counts.length / colours.length, image = new ImageData(columns, colours.length), pixels = new Uint32Array(image.data.buffer);
    let most = 1;
    for (let k = 0; k < counts.length; ++k) if (counts[k] > most) most = counts[k];
    colours.forEach((colour, y) => {
        const [red, green, blue] = components(colour), opaque = (blue << 16) | (green << 8) | red;
        for (let k = y * columns; k < (y + 1) * columns; ++k)
            if (counts[k]) pixels[k] = ((minAlpha + (255 - minAlpha) * Math.sqrt(counts[k] / most)) << 24) | opaque;
    });
    if (canvas.width !== columns || canvas.height !== colours.length) [canvas.width, canvas.height] = [columns, colours.length];
    canvas.getContext("2d")!.putImageData(image, 0, 0);
    return canvas;
}
