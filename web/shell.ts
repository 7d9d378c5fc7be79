// The parts that all pages have: heading, command, notes, toolbar of the time axis, sections, versions.

import {Child, append, h} from "./base/dom";
import {onAppearanceChange} from "./base/colours";
import {fixedText} from "./base/text";
import type {PageData} from "./data/document";
import {connectKeys} from "./plot/pointer";
import type {View} from "./plot/view";

/// Adds the heading of the page to the document, and returns the element for its content.
export function startPage({title, program, command, notes = []}: PageData): HTMLElement {
    const main = h("main");
    append(document.body,
        h("header", {}, h("h1", {id: "title"}, title), h("span", {class: "program", id: "program"}, program), command ? commandLine(command) : null,
          h("ul", {class: "notes", id: "notes", "aria-label": "notes", hidden: true}), h("button", {type: "button", id: "all-notes", hidden: true, onclick: showAllNotes}, "More notes")),
        main);
    notes.forEach(addNote);
    return main;
}

/// Adds a note below the heading.
export function addNote(text: string) {
    const list = document.getElementById("notes")!;
    list.hidden = false;
    list.append(h("li", {}, text));
    document.getElementById("all-notes")?.toggleAttribute("hidden", list.childElementCount <= 2);
}

function showAllNotes() {
    document.getElementById("notes")!.classList.add("all");
    document.getElementById("all-notes")!.remove();
}

function commandLine(command: string): HTMLElement {
    const button: HTMLButtonElement = h("button", {type: "button", onclick: () => copy(command, button)}, "Copy");
    return h("div", {class: "command"}, h("code", {id: "command", "aria-label": "command line"}, command), button);
}

/// Copies a text, and says so on the button for a second.
export function copy(text: string, button: HTMLButtonElement) {
    const label = button.textContent, say = (done: string) => {
        button.textContent = done;
        setTimeout(() => { button.textContent = label; }, 1000);
    };
    const byHand = () => {
        const area = h("textarea", {}, text);
        document.body.append(area);
        area.select();
        say(document.execCommand("copy") ? "Copied" : "Not allowed");
        area.remove();
    };
    if (navigator.clipboard) navigator.clipboard.writeText(text).then(() => say("Copied"), byHand);
    else byHand();
}

/// A section with a heading. `about`: a remark after the title; `colour`: of a mark before it.
export function section(host: Element, id: string, title: Child, about = "", colour = ""): HTMLElement {
    const node = h("section", {id}, h("h2", {}, colour ? h("span", {class: "chip", style: `background: ${colour}`}) : null, title, about ? h("small", {}, about) : null));
    host.append(node);
    return node;
}

/// Draws the content of a folded section.
const drawFold = new WeakMap<Element, () => void>();

const PRINT_WIDTH = 700;  // of figures and tables, pixels; see shell.css

/// Makes each table that is wider than the paper smaller.
function fitTables() {
    document.querySelectorAll<HTMLElement>(".scroll > table").forEach((table) => {
        if (table.offsetWidth > PRINT_WIDTH) table.style.setProperty("zoom", String(PRINT_WIDTH / table.offsetWidth));
    });
}

// At the import, so that views, which are made later, draw after this.
addEventListener("beforeprint", () => {
    document.documentElement.classList.add("printing");
    document.querySelectorAll<HTMLDetailsElement>("details.fold:not([open])").forEach((node) => {
        node.open = true;
        node.dataset.closed = "";
        drawFold.get(node)!();
    });
    fitTables();
});
addEventListener("afterprint", () => {
    document.documentElement.classList.remove("printing");
    document.querySelectorAll<HTMLElement>(".scroll > table").forEach((table) => table.style.removeProperty("zoom"));
    document.querySelectorAll<HTMLDetailsElement>("details.fold[data-closed]").forEach((node) => {
        node.open = false;
        delete node.dataset.closed;
    });
});

/// A section that is folded until the user opens it. `draw` is called at the first opening, with the element for the content.
export function folded(host: Element, id: string, title: Child, about: string, colour: string, draw: (host: HTMLElement) => void, isOpen = false): HTMLDetailsElement {
    const content = h("div"), node = h("details", {class: "fold", id, open: isOpen},
        h("summary", {}, colour ? h("span", {class: "chip", style: `background: ${colour}`}) : null, title, about ? h("small", {}, about) : null), content);
    let isDrawn = false;
    const drawOnce = () => {
        if (isDrawn || !node.open) return;
        isDrawn = true;
        draw(content);
    };
    node.addEventListener("toggle", drawOnce);
    drawFold.set(node, drawOnce);
    host.append(node);
    drawOnce();
    return node;
}

/// The toolbar of a view over time, with its keys. `first`: elements before the buttons.
export function timeToolbar(host: Element, view: View, ...first: Child[]): HTMLElement {
    const button = (text: string, name: string, title: string, act: () => void) => h("button", {type: "button", title, "aria-label": name, onclick: act}, text);
    const span = h("span", {class: "readout", id: "span"}), now = h("span", {class: "readout strong", id: "now"});
    const autoscale: HTMLInputElement = h("input", {type: "checkbox", id: "autoscale", onchange: () => view.setAutoscale(autoscale.checked)});
    const bar = h("div", {class: "toolbar", role: "toolbar", "aria-label": "time"}, ...first,
        h("span", {class: "buttons"}, button("◀", "Earlier", "Earlier (left arrow)", () => view.pan(-0.25)), button("−", "Zoom out", "Zoom out (−)", () => view.zoom(2)),
          button("+", "Zoom in", "Zoom in (+)", () => view.zoom(0.5)), button("▶", "Later", "Later (right arrow)", () => view.pan(0.25)),
          h("button", {type: "button", title: "Show everything (0, or double click)", onclick: () => view.reset()}, "Reset")),
        h("label", {title: "Scale the vertical axes to the visible data"}, autoscale, " Autoscale y"), span, now);
    view.onDraw(() => {
        const step = (view.b - view.a) / 1000;
        autoscale.checked = view.isAutoscale;
        span.textContent = `${fixedText(view.a, step)} to ${fixedText(view.b, step)}`;
    });
    view.onCursor(() => { now.textContent = view.cursor === null ? "" : `t = ${fixedText(view.cursor, (view.b - view.a) / 2000)}`; });
    connectKeys(view);
    onAppearanceChange(() => view.request());
    host.append(bar);
    return bar;
}

/// How to use the figures.
export const hint = () => h("p", {class: "hint"},
    h("span", {class: "for-mouse"}, "Drag to zoom, shift-drag to pan, double click to reset; Ctrl and the wheel zoom. Click a legend to hide a curve. Keys: + − zoom, 0 resets, ← → pan, with Shift they move the cursor, Esc hides it."),
    h("span", {class: "for-touch"}, "Drag sideways to pan, pinch to zoom, double tap to reset. Tap a legend to hide a curve."));

export function showVersions(host: Element, versions: Record<string, string>) {
    const node = section(host, "versions", "Software versions");
    node.append(h("dl", {class: "versions"}, ...Object.entries(versions).map(([name, text]) => h("div", {}, h("dt", {}, name), h("dd", {}, text)))));
}
