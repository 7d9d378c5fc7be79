// Colours are CSS texts such as "var(--ink)", so that one name serves both themes. A canvas needs the colour itself.

interface Colour { components: [number, number, number]; text: string }

const known = new Map<string, Colour>();
let probe: HTMLElement | null = null;

/// The colour of a series, from eight that all common kinds of colour vision can tell apart.
export const seriesColour = (index: number) => `var(--series-${index % 8})`;
export const CLASSES = ["sa1", "fa1", "sa2", "fa2"];
/// The colour of a class of afferents, the same on all pages.
export const classColour = (name: string) => seriesColour(Math.max(0, CLASSES.indexOf(name)));
/// The colour of the k-th of several afferents of one class: the first is pure, others are mixed with the colour of the text or with grey. Each has a contrast of 3 to the paper.
export const variantColour = (name: string, k: number) => (k === 0 ? classColour(name) : mixed(classColour(name), k % 2 ? "var(--ink)" : "var(--axis)", [0.45, 0.6, 0.7, 0.85][(k - 1) % 4]));
/// A mixture: fraction 0 is the first colour, 1 the second.
export const mixed = (first: string, second: string, fraction: number) => `color-mix(in srgb, ${second} ${+(100 * fraction).toFixed(3)}%, ${first})`;

/// Black or white: the one that has more contrast to a colour (red, green, blue from 0 to 255), by the relative luminance of WCAG.
export function inkOn(colour: number[]): string {
    const [r, g, b] = colour.map((v) => (v / 255 <= 0.03928 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b > 0.179 ? "#000" : "#fff";
}

/// The red, green and blue of a CSS colour, 0 to 255.
export function components(css: string): [number, number, number] {
    return colourOf(css).components;
}

/// A CSS colour as a text that canvas and SVG understand.
export function resolved(css: string): string {
    return colourOf(css).text;
}

function colourOf(css: string): Colour {
    const found = known.get(css);
    if (found) return found;
    if (!probe) document.body.append((probe = document.createElement("span")));
    probe.style.display = "none";
    probe.style.color = css;
    const computed = getComputedStyle(probe).color, numbers = (/\(.*\)/.exec(computed) || ["0 0 0"])[0].match(/[\d.]+(e-?\d+)?/g)!.map(Number);
    const factor = computed.startsWith("color(") ? 255 : 1;
    const [r, g, b] = [0, 1, 2].map((k) => Math.round((numbers[k] || 0) * factor));
    const colour: Colour = {components: [r, g, b], text: `rgb(${r}, ${g}, ${b})`};
    known.set(css, colour);
    return colour;
}

/// Calls `redraw` when the theme changes, when the page is printed in the light theme, and on a screen of another density of pixels. Returns a function
/// that ends this.
export function onAppearanceChange(redraw: () => void): () => void {
    const ended = new AbortController(), {signal} = ended, renew = () => {
        known.clear();
        redraw();
    };
    const observer = new MutationObserver(renew);
    const watchPixels = () => matchMedia(`(resolution: ${devicePixelRatio}dppx)`).addEventListener("change", () => { watchPixels(); renew(); }, {once: true, signal});
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", renew, {signal});
    observer.observe(document.documentElement, {attributeFilter: ["class", "data-theme"]});
    watchPixels();
    return () => {
        ended.abort();
        observer.disconnect();
    };
}
