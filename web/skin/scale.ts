// Scales of colours with numbers.

import {Child, h} from "../base/dom";

/// A bar of colours, from left to right, with texts that are spread over its width.
export function colourScale(colours: string[], texts: string[], ...before: Child[]): HTMLElement {
    const bar = h("span", {class: "ramp", style: `background: linear-gradient(to right, ${colours.join(", ")})`});
    return h("span", {class: "scale-key"}, ...before, h("span", {class: "ramp-box"}, bar, h("span", {class: "ramp-texts"}, ...texts.map((text) => h("span", {}, text)))));
}
