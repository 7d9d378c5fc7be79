// Builds elements. Text becomes text nodes, never HTML, so that names from files cannot add elements.

export type Child = Node | string | number | null | undefined | false;
type Attribute = string | number | boolean | null | undefined | ((event: never) => void);
export type Attributes = Record<string, Attribute>;

/// A new element. An attribute that is a function is a listener ("onclick"); null, undefined and false leave the attribute out.
export function h<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
    const node = document.createElement(tag);
    setAttributes(node, attributes);
    append(node, ...children);
    return node;
}

/// A new SVG element.
export function svg<K extends keyof SVGElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): SVGElementTagNameMap[K] {
    const node = document.createElementNS("http://www.w3.org/2000/svg", tag);
    setAttributes(node, attributes);
    append(node, ...children);
    return node;
}

function setAttributes(node: Element, attributes: Attributes) {
    for (const [name, value] of Object.entries(attributes)) {
        if (typeof value === "function") node.addEventListener(name.slice(2), value as EventListener);
        else if (value !== null && value !== undefined && value !== false) node.setAttribute(name, value === true ? "" : String(value));
    }
}

export function append(node: Element, ...children: Child[]) {
    node.append(...children.filter((child) => child !== null && child !== undefined && child !== false).map((child) => (child instanceof Node ? child : String(child))));
}

/// Replaces the children of a node.
export function fill(node: Element, ...children: Child[]) {
    node.replaceChildren();
    append(node, ...children);
}

/// A selector with a label. `choose` is called with the index of the option that the user selects.
export function chooser(label: string, options: string[], selected: number, choose: (index: number) => void): HTMLLabelElement {
    const select: HTMLSelectElement = h("select", {onchange: () => choose(select.selectedIndex)}, ...options.map((text) => h("option", {}, text)));
    select.selectedIndex = selected;
    return h("label", {class: "chooser"}, `${label} `, select);
}

/// True on the screen of a phone: figures then have narrower margins.
export const isNarrow = () => document.documentElement.clientWidth < 520;

/// True on a very wide screen: figures then are higher and have larger texts.
export const isWide = () => document.documentElement.clientWidth >= 2200;

/// Pixels of a canvas per CSS pixel.
export const pixelRatio = () => (document.documentElement.classList.contains("printing") ? 3 : devicePixelRatio || 1);

/// Downloads a file that the page has made.
export function download(name: string, content: Blob | string, type = "text/csv") {
    const url = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], {type}));
    h("a", {href: url, download: name}).click();
    setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
