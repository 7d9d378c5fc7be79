// The menu that saves a figure.

import {resolved} from "../base/colours";
import {download, h} from "../base/dom";

const fileName = (name: string) => name.replace(/[^\p{L}\p{N}.-]+/gu, "-");

/// A menu with the formats of a figure. PNG is the canvas as it is shown.
export function saveMenu(name: string, canvas: HTMLCanvasElement, svg: () => string, csv?: () => string): HTMLDetailsElement {
    const item = (text: string, save: () => void) => h("button", {type: "button", onclick: () => { save(); list.removeAttribute("open"); }}, text);
    const list: HTMLDetailsElement = h("details", {class: "menu"}, h("summary", {title: "Save this figure", "aria-label": `Save the figure ${name}`}, "⋯"),
        h("div", {}, item("PNG", () => savePng(name, canvas)), item("SVG", () => download(`${fileName(name)}.svg`, svg(), "image/svg+xml")),
          csv ? item("CSV", () => download(`${fileName(name)}.csv`, csv())) : null));
    return list;
}

function savePng(name: string, canvas: HTMLCanvasElement) {
    const copy = h("canvas", {width: canvas.width, height: canvas.height}), pen = copy.getContext("2d")!;
    pen.fillStyle = resolved("var(--paper)");
    pen.fillRect(0, 0, copy.width, copy.height);
    pen.drawImage(canvas, 0, 0);
    copy.toBlob((blob) => blob && download(`${fileName(name)}.png`, blob));
}
