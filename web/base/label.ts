// Labels with symbols: in "V_G (V)" the V is italic and has the subscript G. Names that users type, such as "press.F_max", stay as they are.

import {Child, h} from "./dom";
import type {Pen} from "../plot/pen";

type Run = {text: string; kind: "plain" | "symbol" | "subscript"};
const SYMBOL = /(^|[^\w.])([A-Za-z]{1,2}|alpha|beta|gamma|sigma|tau|theta|phi)_([A-Za-z0-9]{1,6}|[+−-])(?![\w.])/g;
const GREEK: Record<string, string> = {alpha: "α", beta: "β", gamma: "γ", sigma: "σ", tau: "τ", theta: "θ", phi: "φ"};

export function labelRuns(label: string): Run[] {
    const runs: Run[] = [];
    let from = 0;
    for (const match of label.matchAll(SYMBOL)) {
        const [all, before, letter, subscript] = match, plain = label.slice(from, match.index!) + before;
        if (plain) runs.push({text: plain, kind: "plain"});
        runs.push({text: GREEK[letter] || letter, kind: "symbol"}, {text: subscript.replace("-", "−"), kind: "subscript"});
        from = match.index! + all.length;
    }
    if (from < label.length) runs.push({text: label.slice(from), kind: "plain"});
    return runs;
}

/// A label as text nodes; a symbol and its subscript stay on one line.
export function label(text: string): Child[] {
    const out: Child[] = [], runs = labelRuns(text);
    runs.forEach((run, k) => {
        if (run.kind === "plain") out.push(run.text);
        if (run.kind === "symbol") out.push(h("span", {class: "symbol"}, h("i", {}, run.text), h("sub", {}, runs[k + 1].text)));
    });
    return out;
}

/// Writes a label with its baseline at y. `x`: of its left end, middle or right end.
export function writeLabel(pen: Pen, text: string, x: number, y: number, align: "left" | "center" | "right" = "left") {
    const runs = labelRuns(text), base = pen.font, size = Number(/([\d.]+)px/.exec(base)![1]);
    const fonts = {plain: base, symbol: `italic ${base}`, subscript: base.replace(/[\d.]+px/, `${Math.round(size * 0.8)}px`)};
    const widths = runs.map((run) => {
        pen.font = fonts[run.kind];
        return pen.measureText(run.text).width;
    });
    let at = x - widths.reduce((sum, w) => sum + w, 0) * {left: 0, center: 0.5, right: 1}[align];
    pen.textAlign = "left";
    runs.forEach((run, k) => {
        pen.font = fonts[run.kind];
        pen.fillText(run.text, at, y + (run.kind === "subscript" ? 3 : 0));
        at += widths[k];
    });
    pen.font = base;
}
