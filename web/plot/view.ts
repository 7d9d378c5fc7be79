// The range of x and the cursor that linked panels share. Panels are drawn at most once per screen frame.

import type {Panel} from "./panel";

export interface Limits { begin: number; end: number; smallest: number }

export class View {
    panels: Panel[] = [];
    a = 0;
    b = 1;
    begin = 0;
    end = 1;
    private smallest = 1e-9;  // length of the shortest visible range
    cursor: number | null = null;
    isAutoscale = false;
    private isWaiting = false;
    private isCursorWaiting = false;
    private listeners: (() => void)[] = [];
    private cursorListeners: (() => void)[] = [];
    private ended = new AbortController();  // of the window's events

    /// `unit`: of x, "s" for time.
    constructor(readonly unit = "s") {
        const {signal} = this.ended;
        addEventListener("beforeprint", () => this.draw(), {signal});
        addEventListener("afterprint", () => this.request(), {signal});
    }

    /// Removes all panels from the page, for good.
    remove() {
        this.clear();
        this.ended.abort();
    }

    /// Sets the range that can be shown. `keep`: keep the visible range and the cursor, else show everything.
    setLimits({begin, end, smallest}: Limits, keep = false) {
        Object.assign(this, {begin, end: Math.max(end, begin + smallest), smallest});
        if (keep) this.set(this.a, this.b);
        else [this.a, this.b, this.cursor] = [this.begin, this.end, null];
        this.request();
    }

    add(...panels: Panel[]) {
        for (const panel of panels) panel.connect(this);
        this.panels.push(...panels);
        this.request();
    }

    /// Removes all panels from the page.
    clear() {
        this.panels.forEach((panel) => panel.remove());
        this.panels = [];
    }

    /// Sets the visible range to [a, b], limited to what there is and to at least the smallest range.
    set(a: number, b: number) {
        const length = Math.min(Math.max(b - a, this.smallest), this.end - this.begin);
        const middle = (a + b) / 2;
        this.a = Math.max(this.begin, Math.min(this.end - length, b - a === length ? a : middle - length / 2));
        this.b = this.a + length;
        this.request();
    }

    reset() { this.set(this.begin, this.end); }
    get isComplete() { return this.a <= this.begin && this.b >= this.end; }
    pan(fraction: number) { this.set(this.a + fraction * (this.b - this.a), this.b + fraction * (this.b - this.a)); }

    /// Multiplies the length of the visible range by `factor`; `centre` keeps its place.
    zoom(factor: number, centre = this.middle()) { this.set(centre - (centre - this.a) * factor, centre + (this.b - centre) * factor); }

    /// The cursor if it is visible, else the middle of the visible range.
    private middle() { return this.cursor !== null && this.cursor > this.a && this.cursor < this.b ? this.cursor : (this.a + this.b) / 2; }

    /// Moves the cursor to x, or removes it if x is null.
    point(x: number | null) {
        this.cursor = x === null ? null : Math.max(this.begin, Math.min(this.end, x));
        this.requestCursor();
    }

    setAutoscale(on: boolean) {
        this.isAutoscale = on;
        this.request();
    }

    /// Calls `listener` after each drawing, or after each change of the cursor.
    onDraw(listener: () => void) { this.listeners.push(listener); }
    onCursor(listener: () => void) { this.cursorListeners.push(listener); }

    /// Draws all panels at the next screen frame.
    request() {
        if (!this.isWaiting) requestAnimationFrame(() => this.isWaiting && this.draw());
        this.isWaiting = true;
    }

    private requestCursor() {
        if (!this.isCursorWaiting) requestAnimationFrame(() => this.drawCursor());
        this.isCursorWaiting = true;
    }

    /// All panels have the margins that the widest labels need, so that they align.
    draw() {
        this.isWaiting = false;
        const shown = this.panels.filter((panel) => panel.isShown);
        for (const panel of shown) panel.layOut();
        const left = Math.max(0, ...shown.map((panel) => panel.leftMargin)), right = Math.max(0, ...shown.map((panel) => panel.rightMargin));
        for (const panel of shown) panel.draw(left, right);
        this.drawCursor();
        this.listeners.forEach((listener) => listener());
    }

    private drawCursor() {
        this.isCursorWaiting = false;
        for (const panel of this.panels) if (panel.isShown) panel.showCursor(this.cursor);
        this.cursorListeners.forEach((listener) => listener());
    }
}
