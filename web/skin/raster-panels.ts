// Rasters of a skin: of spike trains, or of counts per frame if there are too many spikes for the page.

import {RasterOptions, RasterPanel, Row, painted} from "../panels/raster-panel";
import {TimePanel, TimePanelOptions} from "../panels/time-panel";
import {Area, csvText} from "../plot/panel";
import type {Pen} from "../plot/pen";
import type {Frames} from "./frames";

export interface SkinRow extends Row { mark: number }

/// The afferent under the pointer is also chosen on the maps: `point` is called with its mark.
export class SkinRasterPanel extends RasterPanel<SkinRow> {
    private point: (mark: number | null) => void;

    constructor(options: RasterOptions<SkinRow> & {point: (mark: number | null) => void}) {
        super(options);
        this.point = options.point;
    }

    hover(x: number, y: number) {
        super.hover(x, y);
        const row = x < 0 ? undefined : this.rows[Math.floor((y - this.area.y) / this.area.h * this.rows.length)];
        this.point(row ? row.mark : null);
    }
}

interface CountRasterOptions extends TimePanelOptions { frames: Frames; t0: number; marks: number[]; colour: string; label: string; nameOf: (mark: number) => string }

/// A row is a mark, and shows its spikes in each frame.
export class CountRasterPanel extends TimePanel {
    constructor(private options: CountRasterOptions) { super(options); }

    protected range(): [number, number] { return [0, Math.max(1, this.options.marks.length)]; }
    protected verticalTicks(_low: number, high: number) { return {values: [high / 2], text: () => this.options.label}; }

    protected paint(pen: Pen, area: Area) {
        super.paint(pen, area);
        const {frames, t0, marks, colour} = this.options, {a, b} = this.view, ratio = devicePixelRatio || 1;
        if (!marks.length) return;
        const columns = Math.round(area.w * ratio), lines = Math.min(marks.length, Math.floor(area.h * ratio)), rowOf = new Map(marks.map((mark, row) => [mark, row]));
        const counts = new Uint32Array(lines * columns), column = (t: number) => Math.max(0, Math.min(columns, Math.round((t - a) / (b - a) * columns)));
        for (let f = 0; f < frames.count; ++f) {
            const from = column(t0 + f * frames.width), to = column(t0 + (f + 1) * frames.width);
            if (from >= to) continue;  // not visible
            frames.each(f, (mark, n) => {
                const row = rowOf.get(mark);
                if (row !== undefined) for (let c = from, line = Math.floor(row * lines / marks.length) * columns; c < to; ++c) counts[line + c] += n;
            });
        }
        pen.imageSmoothingEnabled = false;
        pen.drawImage(painted(counts, Array(lines).fill(colour), 110), 0, 0, columns, lines, area.x, area.y, area.w, area.h);
    }

    csv() {
        const {frames, t0, marks, nameOf} = this.options, shown = new Set(marks), rows: (string | number)[][] = [];
        for (let f = 0; f < frames.count; ++f) frames.each(f, (mark, n) => { if (shown.has(mark)) rows.push([nameOf(mark), t0 + f * frames.width, n]); });
        return csvText(["afferent", "time_s", "spikes"], rows);
    }
}
