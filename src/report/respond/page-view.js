"use strict";
// The time range and the cursor that all panels share. Each panel is drawn at most once per screen frame.

/// Times in s: a and b are the ends of the visible range, begin and end those of the complete recording. `cursor` is the time under the
/// pointer, or null if it is not on a panel. `span` and `now`: the page's elements that show the visible range and the cursor's time.
class View {
    constructor({span, now}) {
        Object.assign(this, {span, now, panels: [], autoscale: false, cursor: null, waiting: false});
        new ResizeObserver(() => this.resized()).observe(document.getElementById("figures"));
    }

    /// Shows panels of one input. `keep`: keep the time range and the cursor, else show the complete recording.
    show(panels, input, keep) {
        this.input = input;
        [this.begin, this.end] = [input.t0, endOf(input)];
        if (!keep) [this.a, this.b, this.cursor] = [this.begin, this.end, null];
        this.panels = panels;
        this.rightMargin = Math.max(...panels.map((panel) => panel.rightMargin));  // the same for all panels, so that times align
        for (const panel of panels) {
            panel.start(this);
            connectMouse(panel, this);
        }
        this.draw();
    }

    clear() {
        this.panels.forEach((panel) => panel.destroy());
        this.panels = [];
    }

    /// Sets the visible range to [a, b], limited to the recording and extended to at least four samples.
    set(a, b) {
        const length = Math.min(Math.max(b - a, 4 * this.input.T), this.end - this.begin);
        const middle = (a + b) / 2;
        this.a = Math.max(this.begin, Math.min(this.end - length, b - a === length ? a : middle - length / 2));
        this.b = this.a + length;
        this.request();
    }

    reset() { this.set(this.begin, this.end); }
    pan(fraction) { this.set(this.a + fraction * (this.b - this.a), this.b + fraction * (this.b - this.a)); }

    /// Multiplies the length of the visible range by `factor`; `centre` (s) keeps its place.
    zoom(factor, centre = this.middle()) { this.set(centre - (centre - this.a) * factor, centre + (this.b - centre) * factor); }

    /// The cursor's time if it is visible, else the middle of the visible range.
    middle() { return this.cursor !== null && this.cursor > this.a && this.cursor < this.b ? this.cursor : (this.a + this.b) / 2; }

    /// Sets the cursor to time t, or removes it if t is null.
    point(t) {
        this.cursor = t === null ? null : Math.max(this.begin, Math.min(this.end, t));
        this.requestCursor();
    }

    // Draw all panels, or only the cursor, at the next screen frame.
    request() {
        if (!this.waiting) requestAnimationFrame(() => this.waiting && this.draw());
        this.waiting = true;
    }

    requestCursor() {
        if (!this.pointing) requestAnimationFrame(() => this.drawCursor());
        this.pointing = true;
    }

    draw() {
        this.waiting = false;
        for (const panel of this.panels) panel.draw(this.a, this.b, this.autoscale);
        const step = (this.b - this.a) / 1000;
        this.span.textContent = `${timeText(this.a, step)} to ${timeText(this.b, step)}`;
        this.drawCursor();
    }

    drawCursor() {
        this.pointing = false;
        const t = this.cursor;
        for (const panel of this.panels) {
            placeHairline(panel, t, this);
            if (t !== null) panel.showValues(t);
            else panel.clearValues();
        }
        const phase = t !== null && phaseAt(this.input, t);
        this.now.textContent = t === null ? "" : `t = ${timeText(t, (this.b - this.a) / 2000)}${phase ? ", " + phase.name : ""}`;
    }

    resized() {
        for (const panel of this.panels) panel.chart.resize();
        if (this.panels.length) this.request();
    }
}

function placeHairline(panel, t, {a, b}) {
    const {style} = panel.hairline;
    const area = panel.area;
    style.display = t === null || t < a || t > b ? "none" : "block";
    style.left = area.x + (t - a) / (b - a) * area.w + "px";
    style.height = area.h + "px";
}

/// Drag zooms, shift-drag (or a finger) pans, a click is passed to the panel, double click resets, Ctrl with the wheel zooms about the pointer.
function connectMouse(panel, view) {
    const positionOf = (event) => {
        const box = panel.plot.getBoundingClientRect();
        return {x: Math.max(panel.area.x, Math.min(panel.area.x + panel.area.w, event.clientX - box.left)), y: event.clientY - box.top};
    };
    const timeAt = (x, a = view.a, b = view.b) => a + (x - panel.area.x) / panel.area.w * (b - a);
    let drag = null;

    panel.plot.addEventListener("pointerdown", (event) => {
        if (event.button !== 0) return;
        drag = {...positionOf(event), a: view.a, b: view.b, isPan: event.shiftKey || event.pointerType === "touch"};
        panel.plot.setPointerCapture(event.pointerId);
    });
    panel.plot.addEventListener("pointermove", (event) => {
        const {x} = positionOf(event);
        if (!drag || !drag.isPan) view.point(timeAt(x));
        if (drag && drag.isPan) {
            const shift = timeAt(drag.x, drag.a, drag.b) - timeAt(x, drag.a, drag.b);
            view.set(drag.a + shift, drag.b + shift);
        } else if (drag) showSelection(view, drag.x, x);
    });
    panel.plot.addEventListener("pointerup", (event) => {
        if (!drag) return;
        const {x, y} = positionOf(event), {x: from, isPan} = drag;
        drag = null;
        showSelection(view, 0, 0);
        if (Math.abs(x - from) < 4) panel.click(x, y);
        else if (!isPan) view.set(timeAt(Math.min(x, from)), timeAt(Math.max(x, from)));
    });
    panel.plot.addEventListener("pointercancel", () => {
        drag = null;
        showSelection(view, 0, 0);
    });
    panel.plot.addEventListener("dblclick", () => view.reset());
    panel.plot.addEventListener("wheel", (event) => {
        if (!event.ctrlKey) return;  // the wheel alone scrolls the page
        event.preventDefault();
        view.zoom(1.2 ** Math.sign(event.deltaY), timeAt(positionOf(event).x));
    }, {passive: false});
}

function showSelection(view, x, y) {
    for (const {selection, area} of view.panels) {
        selection.style.display = x === y ? "none" : "block";
        selection.style.left = Math.min(x, y) + "px";
        selection.style.width = Math.abs(x - y) + "px";
        selection.style.height = area.h + "px";
    }
}

function connectKeys(view) {
    const keys = {"+": () => view.zoom(0.5), "=": () => view.zoom(0.5), "-": () => view.zoom(2), "0": () => view.reset(),
                  ArrowLeft: () => view.pan(-0.25), ArrowRight: () => view.pan(0.25), Escape: () => view.point(null)};
    document.addEventListener("keydown", (event) => {
        const typing = event.target.closest("select, input, [role=region]");
        if (typing || event.ctrlKey || event.altKey || event.metaKey || !keys[event.key]) return;
        event.preventDefault();
        keys[event.key]();
    });
}
