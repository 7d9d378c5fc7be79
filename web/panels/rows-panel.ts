// A panel with one row for each afferent, channel or trial. The keys up and down reach a row; a click or Enter chooses it.

import {resolved} from "../base/colours";
import type {Area} from "../plot/panel";
import type {Pen} from "../plot/pen";
import {TimePanel, TimePanelOptions} from "./time-panel";

export interface PanelRow { label: string; isChosen?: boolean; about?: string }

/// A method, so that a panel of special rows is also a panel of rows.
type Choice<R> = {choose(row: R): void}["choose"];

export interface RowsOptions<R> extends TimePanelOptions {
    rows: R[];                           ///< the first is at the top
    pick?: Choice<R> | null;    ///< called when a row is chosen
}

export abstract class RowsPanel<R extends PanelRow> extends TimePanel {
    rows: R[];
    protected pick: Choice<R> | null;
    protected strip = 0;  // above the rows, pixels
    private current = -1;  // row that the keys have reached

    constructor(options: RowsOptions<R>) {
        super({...options, about: `${options.about} (up and down reach a row${options.pick ? ", Enter chooses it" : ""})`});
        [this.rows, this.pick] = [options.rows, options.pick || null];
        if (this.pick) this.plot.style.cursor = "pointer";
        this.plot.addEventListener("blur", () => this.view.request());
    }

    protected get shownRows() { return this.rows; }
    /// The area of the rows, below the strip.
    protected inner({x, y, w, h: height}: Area = this.area): Area { return {x, y: y + this.strip, w, h: height - this.strip}; }

    /// A row has height 1.
    protected range(): [number, number] { return [0, Math.max(this.shownRows.length, 1) * this.height / (this.height - this.strip)]; }

    private rowAt(y: number): R | undefined {
        const {y: top, h: height} = this.inner(), rows = this.shownRows;
        return rows[Math.floor((y - top) / height * rows.length)];
    }

    /// A text and its place for a row under the pointer.
    protected abstract tipOf(row: R, x: number, y: number): {x: number; y: number; text: string};
    protected tipAt(x: number, y: number) {
        const row = this.rowAt(y);
        return row ? this.tipOf(row, x, y) : null;
    }

    click(_x: number, y: number) { this.choose(this.rowAt(y)); }
    private choose(row: R | undefined) { if (row && this.pick && !row.isChosen) this.pick(row); }

    protected key(name: string) {
        const rows = this.shownRows, step = {ArrowDown: 1, ArrowUp: -1}[name];
        if (!rows.length || (!step && !(this.pick && name === "Enter"))) return false;
        const row = this.reachedRow();
        if (!step) this.choose(row);
        else this.current = Math.max(0, Math.min(rows.length - 1, this.current + step));
        this.view.request();
        this.hover(this.inner().x + 12, this.middleOfReached());
        return true;
    }

    /// The row that the keys have reached; at first the chosen one, or the first.
    protected reachedRow(): R {
        const rows = this.shownRows;
        if (this.current < 0) this.current = Math.max(0, rows.findIndex(({isChosen}) => isChosen));
        return rows[this.current = Math.min(this.current, rows.length - 1)];
    }

    /// Its place, in pixels.
    protected middleOfReached() {
        const {y, h: height} = this.inner();
        return y + (this.current + 0.5) * height / this.shownRows.length;
    }

    /// Outlines the row that the keys have reached.
    protected paintCurrent(pen: Pen, area: Area) {
        if (this.current < 0 || document.activeElement !== this.plot) return;
        const height = area.h / this.shownRows.length;
        pen.strokeStyle = resolved("var(--accent)");
        pen.lineWidth = 2;
        pen.beginPath();
        pen.rect(area.x + 1, area.y + this.current * height, area.w - 2, Math.max(2, height));
        pen.stroke();
    }
}
