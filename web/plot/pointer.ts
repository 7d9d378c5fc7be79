// Pointer, wheel, touch and keys of panels that share a view.

import type {Panel} from "./panel";
import type {View} from "./view";

/// Mouse: drag zooms, shift-drag pans, a click is passed to the panel, a double click resets. Touch: one finger pans, two fingers zoom, a double
/// tap resets. The wheel zooms about the pointer with Ctrl, or if the panel has the focus; otherwise it scrolls the page.
export function connectPointer(panel: Panel, view: View) {
    const {plot} = panel, fingers = new Map<number, number>();  // x of each finger
    let drag: {x: number; a: number; b: number; isPan: boolean} | null = null;
    let lastTap = 0;
    const place = (event: MouseEvent) => {
        const box = plot.getBoundingClientRect(), {x, w} = panel.area;
        return {x: Math.max(x, Math.min(x + w, event.clientX - box.left)), y: event.clientY - box.top};
    };
    const valueAt = (x: number, a = view.a, b = view.b) => a + (x - panel.area.x) / panel.area.w * (b - a);

    /// Two fingers: the values under them stay under them.
    const pinch = (before: number[], after: number[]) => {
        const [p, q] = before.map((x) => valueAt(x)), span = Math.abs(after[1] - after[0]);
        if (span < 8) return;
        const scale = (q - p) / (after[1] - after[0]), a = p - (after[0] - panel.area.x) * scale;
        if (scale > 0) view.set(a, a + scale * panel.area.w);
    };

    plot.addEventListener("pointerdown", (event) => {
        if (event.button !== 0) return;
        const {x} = place(event), isTouch = event.pointerType === "touch";
        if (isTouch) {
            fingers.set(event.pointerId, x);
            panel.hover(-1, -1);  // the text of the last tap, which may be about to move
        }
        drag = {x, a: view.a, b: view.b, isPan: event.shiftKey || isTouch};
        plot.setPointerCapture(event.pointerId);
    });
    plot.addEventListener("pointermove", (event) => {
        const {x, y} = place(event);
        if (fingers.size === 2 && fingers.has(event.pointerId)) {
            const before = [...fingers.values()];
            fingers.set(event.pointerId, x);
            pinch(before, [...fingers.values()]);
        } else if (drag && drag.isPan) {
            const shift = valueAt(drag.x, drag.a, drag.b) - valueAt(x, drag.a, drag.b);
            view.set(drag.a + shift, drag.b + shift);
        } else {
            view.point(valueAt(x));
            panel.hover(x, y);
            if (drag) view.panels.forEach((one) => one.showSelection(drag!.x, x));
        }
    });
    const end = (event: PointerEvent) => {
        fingers.delete(event.pointerId);
        view.panels.forEach((one) => one.showSelection(0, 0));
        const last = drag;
        drag = null;
        return last;
    };
    plot.addEventListener("pointerup", (event) => {
        const {x, y} = place(event), from = end(event);
        if (!from) return;
        if (Math.abs(x - from.x) >= 4) {
            if (!from.isPan) view.set(valueAt(Math.min(x, from.x)), valueAt(Math.max(x, from.x)));
            return;
        }
        if (event.pointerType === "touch" && event.timeStamp - lastTap < 350) view.reset();
        lastTap = event.timeStamp;
        view.point(valueAt(x));
        panel.hover(x, y);
        panel.click(x, y);
    });
    plot.addEventListener("pointercancel", end);
    plot.addEventListener("pointerleave", ({pointerType}) => { if (pointerType !== "touch") panel.hover(-1, -1); });  // a finger leaves after each tap
    plot.addEventListener("blur", () => panel.hover(-1, -1));
    plot.addEventListener("dblclick", () => view.reset());
    plot.addEventListener("wheel", (event) => {
        if (!event.ctrlKey && !plot.contains(document.activeElement)) return;
        event.preventDefault();
        const {x} = place(event);
        if (Math.abs(event.deltaX) > Math.abs(event.deltaY)) view.pan(event.deltaX / 1000);
        else view.zoom(1.0015 ** Math.max(-300, Math.min(300, event.deltaY)), valueAt(x));
    }, {passive: false});
}

/// Keys: + and - zoom, 0 resets, arrows pan, with Shift they move the cursor, Escape removes it. `host`: takes the keys of the elements in it.
export function connectKeys(view: View, host: Element | Document = document) {
    const step = (direction: number) => view.point((view.cursor ?? (view.a + view.b) / 2) + direction * (view.b - view.a) / 200);
    const keys: Record<string, (event: KeyboardEvent) => void> = {
        "+": () => view.zoom(0.5), "=": () => view.zoom(0.5), "-": () => view.zoom(2), "0": () => view.reset(), "Escape": () => view.point(null),
        "ArrowLeft": (event) => (event.shiftKey ? step(-1) : view.pan(-0.25)), "ArrowRight": (event) => (event.shiftKey ? step(1) : view.pan(0.25)),
    };
    host.addEventListener("keydown", (any) => {
        const event = any as KeyboardEvent;
        const isTyping = (event.target as Element).closest("select, input, textarea, summary, [role=region], [role=slider]");
        if (isTyping || event.defaultPrevented || event.ctrlKey || event.altKey || event.metaKey || !keys[event.key]) return;
        event.preventDefault();
        keys[event.key](event);
    });
}
