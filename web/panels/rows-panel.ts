// A panel with one row for each afferent, channel or trial. A row is chosen by a click, or with the keys up, down and Enter.

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
        super({...options, about: options.pick ? `${options.about} (up and down reach a row, Enter chooses it)` : options.about});
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
        if (!this.pick || (!step && name !== "Enter")) return false;
        if (this.current < 0) this.current = Math.max(0, rows.findIndex(({isChosen}) => isChosen));
        if (!step) this.choose(rows[this.current]);
        else this.current = Math.max(0, Math.min(rows.length - 1, this.current + step));
        this.view.request();
        const {x, y, h: height} = this.inner();
        this.hover(x + 12, y + (this.current + 0.5) * height / rows.length);
        return true;
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
