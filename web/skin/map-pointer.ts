// Pointer, wheel, touch and keys of a map.

import type {SkinMap} from "./skin-map";

/// Mouse: a drag pans, Ctrl and the wheel zoom (the wheel alone if the map has the focus), a double click shows the complete skin. Touch: two
/// fingers pan and zoom; one finger scrolls the page, or pans if the map is zoomed; a tap chooses a mark. Keys: arrows, + and −, 0.
export function connectMapPointer(map: SkinMap) {
    const {canvas, scene} = map, fingers = new Map<number, [number, number]>();
    let isDrag = false, path = 0;
    const at = (event: MouseEvent): [number, number] => [event.offsetX, event.offsetY];
    const move = (event: PointerEvent) => {
        const before = [...fingers.values()], old = fingers.get(event.pointerId)!;
        fingers.set(event.pointerId, at(event));
        path += Math.hypot(event.offsetX - old[0], event.offsetY - old[1]);
        const after = [...fingers.values()];
        if (after.length === 2) zoomBetween(map, before, after);
        else if (after.length === 1) scene.pan(event.offsetX - old[0], event.offsetY - old[1]);
    };
    canvas.addEventListener("pointerdown", (event) => {
        if (event.button !== 0) return;
        fingers.set(event.pointerId, at(event));
        [isDrag, path] = [true, 0];
        if (event.pointerType !== "touch" || fingers.size === 2) canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
        if (fingers.has(event.pointerId) && (event.pointerType !== "touch" || fingers.size > 1 || !scene.isComplete)) move(event);
        else if (!isDrag) point(map, ...at(event));
    });
    const end = (event: PointerEvent) => {
        fingers.delete(event.pointerId);
        isDrag = fingers.size > 0;
    };
    canvas.addEventListener("pointerup", (event) => {
        end(event);
        if (path < 6) point(map, ...at(event), event.pointerType === "touch" ? 24 : 12);
    });
    canvas.addEventListener("pointercancel", end);
    canvas.addEventListener("pointerleave", (event) => { if (!isDrag && event.pointerType !== "touch") point(map, -99, -99); });
    canvas.addEventListener("dblclick", () => scene.show(scene.all));
    canvas.addEventListener("touchstart", (event) => { if (event.touches.length > 1) event.preventDefault(); }, {passive: false});
    canvas.addEventListener("wheel", (event) => {
        if (!event.ctrlKey && document.activeElement !== canvas) return;
        event.preventDefault();
        scene.zoom(1.0015 ** Math.max(-300, Math.min(300, event.deltaY)), ...at(event));
    }, {passive: false});
    canvas.addEventListener("keydown", (event) => {
        const act = keys(map)[event.key];
        if (!act || event.ctrlKey || event.altKey || event.metaKey) return;
        event.preventDefault();
        event.stopPropagation();
        act();
    });
}

const keys = ({scene}: SkinMap): Record<string, () => void> => ({
    "+": () => scene.zoom(1 / 1.5), "=": () => scene.zoom(1 / 1.5), "-": () => scene.zoom(1.5), "0": () => scene.show(scene.all),
    ArrowLeft: () => scene.pan(40, 0), ArrowRight: () => scene.pan(-40, 0), ArrowUp: () => scene.pan(0, 40), ArrowDown: () => scene.pan(0, -40),
});

/// Two fingers: the skin under them stays under them, as far as their distance tells.
function zoomBetween({scene}: SkinMap, before: [number, number][], after: [number, number][]) {
    const distance = ([[x, y], [u, v]]: [number, number][]) => Math.hypot(x - u, y - v), middle = ([[x, y], [u, v]]: [number, number][]) => [(x + u) / 2, (y + v) / 2];
    const [x, y] = middle(before), [u, v] = middle(after);
    if (distance(after) > 8) scene.zoom(distance(before) / distance(after), x, y);
    scene.pan(u - x, v - y);
}

/// Names the mark near the point (x, y).
function point(map: SkinMap, x: number, y: number, reach?: number) {
    const {scene, options, tip} = map, mark = map.nearestMark(x, y, reach);
    if (options.pick && mark !== scene.chosen) options.pick(mark);
    tip.style.display = mark !== null && options.describe ? "block" : "none";
    if (mark === null || !options.describe) return;
    tip.textContent = options.describe(mark);
    const [px, py] = map.place(mark), left = Math.max(0, Math.min(px - tip.offsetWidth / 2, scene.width - tip.offsetWidth));
    Object.assign(tip.style, {left: `${left}px`, top: `${py > 60 ? py - tip.offsetHeight - 12 : py + 14}px`});
}
