// The view of the page in its link: input, channel, times, scaling, hidden series, open sections.

import {linkNumber, linkValues} from "../../base/link";

/// `input` and `channel`: their numbers on the page, counted from 1. `hidden`: "panel:series".
export interface ViewState { input: number | null; channel: number | null; from: number | null; to: number | null; isAutoscale: boolean; areAllRows: boolean; hidden: string[]; open: string[] }

/// The view of a link without values.
export const NO_VIEW: ViewState = {input: null, channel: null, from: null, to: null, isAutoscale: false, areAllRows: false, hidden: [], open: []};

const KEYS = ["input", "channel", "from", "to", "autoscale", "all", "hide", "open"];
const MAX_LIST = 1500;  // characters of a list; a longer one is left out, so that the link stays valid

/// Names in a list are separated by commas, so they are encoded once more.
const listOf = (text: string | undefined) => (text ? text.split(",").map(decodeURIComponent) : []);
const listText = (names: string[]) => {
    const text = names.map(encodeURIComponent).join(",");
    return text.length > MAX_LIST ? "" : text;
};

/// The view of the link; null if the link is damaged.
export function readViewLink(): ViewState | null {
    const values = linkValues();
    if (!values || [...values.keys()].some((key) => !KEYS.includes(key))) return null;
    const number = (key: string) => (values.has(key) ? linkNumber(values.get(key)) : undefined);
    const [input, channel, from, to] = ["input", "channel", "from", "to"].map(number);
    if ([input, channel, from, to].includes(null) || (from === undefined) !== (to === undefined) || from! >= to!) return null;
    try {
        return {input: input ?? null, channel: channel ?? null, from: from ?? null, to: to ?? null, isAutoscale: values.get("autoscale") === "1", areAllRows: values.get("all") === "1",
                hidden: listOf(values.get("hide")), open: listOf(values.get("open"))};
    } catch {
        return null;  // a malformed escape
    }
}

/// The values of a view for setLink().
export function viewLinkValues({input, channel, from, to, isAutoscale, areAllRows, hidden, open}: ViewState): Record<string, string | number | null> {
    return {input, channel, from, to, autoscale: isAutoscale ? 1 : null, all: areAllRows ? 1 : null, hide: listText(hidden), open: listText(open)};
}
