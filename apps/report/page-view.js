"use strict";
// The window of time and the cursor that all panels share. Whatever happens between two frames, each panel is drawn once.

class View {
    constructor({span, now}) {
        Object.assign(this, {span, now, panels: [], fit: false, cursor: null, waiting: false});
        new ResizeObserver(() => this.resized()).observe(document.getElementById("figures"));
    }

    /// Shows panels of one input; the window stays where it was if `keep`.
    show(panels, input, keep) {
        this.input = input;
        [this.begin, this.end] = [input.t0, endOf(input)];
        if (!keep) [this.a, this.b, this.cursor] = [this.begin, this.end, null];
        this.panels = panels;
        this.rightRoom = Math.max(...panels.map((panel) => panel.rightRoom));  // one instant stands at one x in all of them
        for (const panel of panels) {
            panel.start(this);
            followMouse(panel, this);
        }
        this.draw();
    }

    clear() {
        this.panels.forEach((panel) => panel.destroy());
        this.panels = [];
    }

    /// The window becomes [a, b], kept inside the recording and no shorter than a few samples.
    set(a, b) {
        const length = Math.min(Math.max(b - a, 4 * this.input.T), this.end - this.begin);
        const middle = (a + b) / 2;
        this.a = Math.max(this.begin, Math.min(this.end - length, b - a === length ? a : middle - length / 2));
        this.b = this.a + length;
        this.request();
    }

    whole() { this.set(this.begin, this.end); }
    pan(share) { this.set(this.a + share * (this.b - this.a), this.b + share * (this.b - this.a)); }

    /// Keeps `centre` where it is on the screen.
    zoom(factor, centre = this.middle()) { this.set(centre - (centre - this.a) * factor, centre + (this.b - centre) * factor); }

    middle() { return this.cursor !== null && this.cursor > this.a && this.cursor < this.b ? this.cursor : (this.a + this.b) / 2; }

    point(t) {
        this.cursor = t === null ? null : Math.max(this.begin, Math.min(this.end, t));
        this.requestCursor();
    }

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
        for (const panel of this.panels) panel.draw(this.a, this.b, this.fit);
        const step = (this.b - this.a) / 1000;
        this.span.textContent = `${timeText(this.a, step)} to ${timeText(this.b, step)}`;
        this.drawCursor();
    }

    drawCursor() {
        this.pointing = false;
        const t = this.cursor;
        for (const panel of this.panels) {
            placeHairline(panel, t, this);
            if (t !== null) panel.read(t);
            else panel.forget();
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

/// Drag zooms, shift-drag (or a finger) pans, a plain click is the panel's own, double click shows the whole,
/// the wheel with control zooms about the pointer.
function followMouse(panel, view) {
    const place = (event) => {
        const box = panel.plot.getBoundingClientRect();
        return {x: Math.max(panel.area.x, Math.min(panel.area.x + panel.area.w, event.clientX - box.left)), y: event.clientY - box.top};
    };
    const timeAt = (x, a = view.a, b = view.b) => a + (x - panel.area.x) / panel.area.w * (b - a);
    let drag = null;

    panel.plot.addEventListener("pointerdown", (event) => {
        if (event.button !== 0) return;
        drag = {...place(event), a: view.a, b: view.b, pans: event.shiftKey || event.pointerType === "touch"};
        panel.plot.setPointerCapture(event.pointerId);
    });
    panel.plot.addEventListener("pointermove", (event) => {
        const {x} = place(event);
        if (!drag || !drag.pans) view.point(timeAt(x));
        if (drag && drag.pans) {
            const shift = timeAt(drag.x, drag.a, drag.b) - timeAt(x, drag.a, drag.b);
            view.set(drag.a + shift, drag.b + shift);
        } else if (drag) showSelection(view, drag.x, x);
    });
    panel.plot.addEventListener("pointerup", (event) => {
        if (!drag) return;
        const {x, y} = place(event), {x: from, pans} = drag;
        drag = null;
        showSelection(view, 0, 0);
        if (Math.abs(x - from) < 4) panel.click(x, y);
        else if (!pans) view.set(timeAt(Math.min(x, from)), timeAt(Math.max(x, from)));
    });
    panel.plot.addEventListener("pointercancel", () => {
        drag = null;
        showSelection(view, 0, 0);
    });
    panel.plot.addEventListener("dblclick", () => view.whole());
    panel.plot.addEventListener("wheel", (event) => {
        if (!event.ctrlKey) return;  // the plain wheel scrolls the page
        event.preventDefault();
        view.zoom(1.2 ** Math.sign(event.deltaY), timeAt(place(event).x));
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

function followKeys(view) {
    const keys = {"+": () => view.zoom(0.5), "=": () => view.zoom(0.5), "-": () => view.zoom(2), "0": () => view.whole(),
                  ArrowLeft: () => view.pan(-0.25), ArrowRight: () => view.pan(0.25), Escape: () => view.point(null)};
    document.addEventListener("keydown", (event) => {
        const typing = event.target.closest("select, input, [role=region]");
        if (typing || event.ctrlKey || event.altKey || event.metaKey || !keys[event.key]) return;
        event.preventDefault();
        keys[event.key]();
    });
}
