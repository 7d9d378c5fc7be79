// Bars in cells of tables: a fraction, and its confidence interval as a line.

import {h} from "../base/dom";

export interface Estimate { value: number | null; low: number | null; high: number | null }

const percentage = (fraction: number) => `${(100 * Math.min(1, Math.max(0, fraction))).toFixed(2)}%`;

/// A bar for a fraction from 0 to 1. Screen readers skip it, because its number is in the table.
export function fractionBar({value, low, high}: Estimate): HTMLElement {
    const hasInterval = low !== null && high !== null;
    return h("span", {class: "fraction-bar", "aria-hidden": "true"}, h("span", {class: "full", style: `width: ${percentage(value || 0)}`}),
        hasInterval ? h("span", {class: "whisker", style: `left: ${percentage(low!)}; width: ${percentage(high! - low!)}`}) : null);
}
