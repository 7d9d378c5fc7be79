// Claims of studies: their verdicts, counts and tables.

import {Child, h} from "../base/dom";
import {label} from "../base/label";
import type {Cell} from "../base/text";
import type {ClaimData, KindData, PlotData, PlotSeries, StudyRecord, Verdict} from "../data/study";
import {Column, table} from "../panels/table";

const AGREES: Verdict[] = ["agrees", "holds"], DIFFERS: Verdict[] = ["differs", "does not hold"];
export const isDeviating = ({verdict}: ClaimData) => DIFFERS.includes(verdict);
const isAgreeing = ({verdict}: ClaimData) => AGREES.includes(verdict);

/// A verdict with a mark, which does not need colour.
const verdictOf = (verdict: Verdict): Child[] =>
    [verdict === "" ? "" : h("span", {class: DIFFERS.includes(verdict) ? "bad" : "good"}, `${DIFFERS.includes(verdict) ? "✗" : "✓"}\u00a0${verdict}`)];

/// "✓ 12 hold, ✗ 2 differ", and how many numbers have nothing to compare with.
export function verdictCounts(claims: ClaimData[]): HTMLElement {
    const good = claims.filter(isAgreeing).length, bad = claims.filter(isDeviating).length, rest = claims.length - good - bad;
    const part = (count: number, kind: string, text: string) => (count ? h("span", {class: kind}, text) : null);
    return h("span", {class: "counts"}, part(good, "good", `✓\u00a0${good} ${good === 1 ? "holds" : "hold"}`), part(bad, "bad", `✗\u00a0${bad} ${bad === 1 ? "differs" : "differ"}`),
             part(rest, "unit", `${rest} without a comparison`));
}

export interface ClaimRow { study: string; claim: ClaimData }

/// The text of a number with its unit: "1.5 um^2" is 1.5 µm².
const typeset = (text: string) => (text === "-" ? "–" : text.replace(/(\d) u(?=[A-Za-z])/g, "$1 µ").replace(/\^2\b/g, "²").replace(/^-(?=\d)/, "−"));

/// The columns of a claim after its heading. Numbers are sorted by value and shown as the texts that C++ wrote.
const claimColumns = (rows: ClaimRow[]): Column[] => {
    const text = (k: number) => (_: Cell, row: number): Child[] => [typeset(rows[row].claim.texts[k])];
    return [
        {name: "computed", isNumber: true, show: text(0)}, {name: "published", isNumber: true, show: text(1)},
        {name: "deviation", isNumber: true, show: text(2)}, {name: "allowed", isNumber: true, show: text(3)},
        {name: "unit", class: "file-only"}, {name: "verdict", class: "verdict", show: (value) => verdictOf(value as Verdict)},
        {name: "kind", class: "unit kind"}, {name: "source and reason", class: "unit reason", show: (value) => label(String(value ?? ""))},
    ];
};

const claimCells = ({computed, published, deviation, high, tolerance, unit, verdict, kind, source, note}: ClaimData): Cell[] =>
    [computed, published, deviation, high ?? tolerance, unit, verdict, verdict && kind, [source, note].filter(Boolean).join("; ")];

/// The table of claims. With `hasStudy` its rows begin with a link to their study.
export function claimTable(name: string, rows: ClaimRow[], hasStudy = false, isShown?: (row: number) => boolean): HTMLElement {
    const what: Column = {name: "claim", class: "what", show: (value) => label(String(value))};
    const study: Column = {name: "study", class: "study", show: (value) => [h("a", {href: `#${value}`}, String(value))]};
    return table({name, columns: [...(hasStudy ? [study] : []), what, ...claimColumns(rows)], isStacked: true, isShown,
                  rows: rows.map(({study: own, claim}) => [...(hasStudy ? [own] : []), claim.label, ...claimCells(claim)]),
                  rowClass: (row) => (isDeviating(rows[row].claim) ? "claim deviating" : "claim")});
}

/// The counts of agreeing and deviating claims of each kind, and the meaning of the kinds.
export function kindTable(kinds: KindData[]): HTMLElement {
    const groups = ["printed", "derived", "statements"] as const, words = {printed: ["printed agree", "printed differ"], derived: ["derived agree", "derived differ"], statements: ["statements hold", "do not hold"]};
    return table({name: "kinds of claims", isStacked: true,
                  columns: [{name: "kind"}, ...groups.flatMap((one) => words[one].map((name) => ({name, isNumber: true}))), {name: "meaning", class: "unit reason"}],
                  rows: kinds.map((one) => [one.kind, ...groups.flatMap((group) => [one[group].agreeing, one[group].deviating]), one.meaning])});
}

/// The deviations of the published numbers as a plot, for a study without figures; null if there are none.
export function deviationPlot({claims}: StudyRecord): PlotData | null {
    const compared = claims.map((claim, k) => ({claim, k})).filter(({claim}) => claim.deviation !== null && claim.verdict !== "");
    const series = [{name: "✓ agrees", isOwn: isAgreeing, colour: 2}, {name: "✗ differs", isOwn: isDeviating, colour: 1}].map(({name, isOwn, colour}): PlotSeries => {
        const own = compared.filter(({claim}) => isOwn(claim));
        return {name, style: "points", x: own.map(({k}) => k + 1), y: own.map(({claim}) => 100 * claim.deviation!), colour};
    });
    return compared.length ? {title: "Deviation from the published numbers", x: "row of the table", y: "deviation (%)", log_x: false, log_y: false, series: series.filter(({x}) => (x as number[]).length)} : null;
}

/// True if the words of a search are in the name, title or claims of a study.
export function matches({name, title, question, claims}: StudyRecord, search: string): boolean {
    const text = [name, title, question, ...claims.map((one) => one.label)].join(" ").toLowerCase();
    return search.toLowerCase().split(/\s+/).every((word) => text.includes(word));
}
