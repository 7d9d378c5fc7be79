// The page of studies: a grid of small pictures with verdicts, each of which opens its figures and claims, then all claims in one table.

import {h, isNarrow} from "../base/dom";
import {label} from "../base/label";
import {linkValues, onLinkChange, setLink} from "../base/link";
import {expose, forgetRemoved} from "../base/panels";
import type {PlotData, StudyData, StudyRecord} from "../data/study";
import {plotPanel, thumbnail} from "../panels/plots";
import {folded, section, showVersions, startPage} from "../shell";
import {ClaimRow, claimTable, deviationPlot, isDeviating, kindTable, matches, verdictCounts} from "./study-claims";

interface Filter { search: string; isDeviatingOnly: boolean; kind: string }

export function showStudyPage(data: StudyData) {
    const main = startPage(data);
    if (data.studies.length === 1) openStudy(section(main, data.studies[0].name, ""), data.studies[0]);
    else showStudies(main, data);
    if (data.versions) showVersions(main, data.versions);
}

function showStudies(main: Element, data: StudyData) {
    const claims: ClaimRow[] = data.studies.flatMap(({name, claims: own}) => own.map((claim) => ({study: name, claim})));
    main.append(h("p", {class: "headline"}, verdictCounts(claims.map(({claim}) => claim)), h("span", {}, data.headline)));
    const filter: Filter = {search: "", isDeviatingOnly: false, kind: ""}, gallery = new Gallery(data.studies, filter);
    const isClaimShown = ({study, claim}: ClaimRow) => gallery.isMatching(study) && (!filter.isDeviatingOnly || isDeviating(claim)) && (!filter.kind || (claim.verdict !== "" && claim.kind === filter.kind));
    const all = claimTable("claims of all studies", claims, true, (row) => isClaimShown(claims[row]));
    const refresh = () => {
        gallery.refresh();
        all.dispatchEvent(new Event("filter"));
    };
    main.append(filterBar(data, filter, refresh), gallery.root);
    section(main, "kinds", "Kinds of claims").append(kindTable(data.kinds));
    folded(main, "claims", "All claims", `${claims.length}`, "", (host) => host.append(all), !isNarrow());  // a phone would show metres of them before the versions
    const follow = () => {
        const values = linkValues();
        if (values?.get("")) gallery.open(values.get("")!);
    };
    onLinkChange(follow);
    follow();
}

function filterBar({kinds}: StudyData, filter: Filter, refresh: () => void): HTMLElement {
    const act = (change: () => void) => () => { change(); refresh(); };
    const search: HTMLInputElement = h("input", {type: "search", id: "search", placeholder: "fig13, mirror, noise …", "aria-label": "Find studies", oninput: act(() => { filter.search = search.value; })});
    const only: HTMLInputElement = h("input", {type: "checkbox", id: "differs", onchange: act(() => { filter.isDeviatingOnly = only.checked; })});
    const kind: HTMLSelectElement = h("select", {id: "kind", onchange: act(() => { filter.kind = kind.selectedIndex ? kind.value : ""; })}, h("option", {}, "all"), ...kinds.map((one) => h("option", {}, one.kind)));
    return h("div", {class: "toolbar", role: "search"}, search, h("label", {}, only, " Differs only"), h("label", {}, "Kind of claim ", kind), h("span", {class: "readout", id: "shown", role: "status"}));
}

/// The grid of studies. A study that is open follows its card over the whole width.
class Gallery {
    readonly root = h("div", {class: "gallery"});
    private cards = new Map<string, {study: StudyRecord; card: HTMLElement; button: HTMLButtonElement; content: HTMLElement | null}>();

    constructor(studies: StudyRecord[], private filter: Filter) {
        for (const study of studies) {
            const [plot] = plotsOf(study), button = h("button", {type: "button", class: "open", "aria-expanded": "false", onclick: () => this.toggle(study.name)},
                plot ? thumbnail(plot) : h("span", {class: "thumbnail empty"}, "statements only"), h("span", {class: "name"}, study.name), h("span", {class: "study-title"}, ...label(study.title)), verdictCounts(study.claims));
            const card = h("article", {class: "card", id: study.name}, button);
            this.cards.set(study.name, {study, card, button, content: null});
            this.root.append(card);
        }
    }

    isMatching(name: string) { return matches(this.cards.get(name)!.study, this.filter.search); }

    /// Shows the studies that the filter leaves.
    refresh() {
        const {isDeviatingOnly, kind} = this.filter;
        let count = 0;
        this.cards.forEach(({study, card, content}) => {
            const has = study.claims.some((claim) => (!isDeviatingOnly || isDeviating(claim)) && (!kind || (claim.verdict !== "" && claim.kind === kind)));
            card.hidden = !matches(study, this.filter.search) || ((isDeviatingOnly || kind !== "") && !has);
            if (content) content.hidden = card.hidden;
            count += Number(!card.hidden);
        });
        document.getElementById("shown")!.textContent = `${count} of ${this.cards.size} studies`;
    }

    private toggle(name: string) {
        if (this.cards.get(name)!.content) this.close(name);
        else this.open(name);
    }

    /// Opens a study and scrolls to it. A name that is not known is ignored.
    open(name: string) {
        const own = this.cards.get(name);
        if (!own) return;
        if (!own.content) {
            own.content = h("section", {class: "opened", "data-study": name});
            own.card.after(own.content);
            own.button.setAttribute("aria-expanded", "true");
            own.content.append(h("button", {type: "button", class: "close", "aria-label": `Close ${name}`, onclick: () => this.close(name)}, "Close"));
            openStudy(own.content, own.study);
        }
        setLink({"": name});
        own.content.style.scrollMarginTop = `${document.querySelector<HTMLElement>(".toolbar")!.offsetHeight + 6}px`;  // which stays at the top, and has two lines on a phone
        own.content.scrollIntoView({block: "start"});
    }

    private close(name: string) {
        const own = this.cards.get(name)!;
        own.content!.remove();
        own.content = null;
        own.button.setAttribute("aria-expanded", "false");
        setLink({});
        forgetRemoved();
        own.card.scrollIntoView({block: "nearest"});
    }
}

function plotsOf(study: StudyRecord): PlotData[] {
    const deviations = study.plots.length ? null : deviationPlot(study);
    return deviations ? [deviations] : study.plots;
}

/// The figures of a study, then its claims and notes.
function openStudy(host: Element, study: StudyRecord) {
    host.append(h("h2", {}, ...label(study.title), h("small", {}, verdictCounts(study.claims))), h("p", {class: "question"}, ...label(study.question)));
    const figures = h("div", {class: "columns"});
    host.append(figures);
    expose(...plotsOf(study).map((plot) => plotPanel(figures, plot, `${study.name}: `)));
    if (study.claims.length) host.append(claimTable(`claims of ${study.name}`, study.claims.map((claim) => ({study: study.name, claim}))));
    for (const note of study.notes) host.append(h("p", {class: "note"}, ...label(note)));
}
