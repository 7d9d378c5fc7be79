// Tables whose columns can be sorted, and saved as CSV.

import {Child, download, fill, h} from "../base/dom";
import {Cell, cellText} from "../base/text";
import {csvText} from "../plot/panel";

export interface Column {
    name: string;
    label?: Child[];
    decimals?: number | null;  ///< of its numbers; four digits if it is not given
    isNumber?: boolean;        ///< aligned to the right
    class?: string;            ///< CSS class of its cells
    show?: (value: Cell, row: number) => Child[];  ///< the content of a cell, if it is not the text of the value
}

export interface TableOptions {
    name: string;   ///< for files and screen readers
    columns: Column[];
    rows: Cell[][];
    rowClass?: (row: number) => string;  ///< CSS class of a row
    hasTotal?: boolean;                  ///< the last row is a total, which stays the last
    isShown?: (row: number) => boolean;  ///< filters the rows; asked again at the event "filter" of the table
    isStacked?: boolean;                 ///< on a narrow screen each row is a list of its cells with their headings
}

/// A table in a region that scrolls. The first column is the heading of each row.
export function table(options: TableOptions): HTMLElement {
    const {name, columns, rows, hasTotal = false} = options, body = h("tbody");
    let order = rows.map((_, k) => k), sorted = -1, direction = 1;
    const heads = columns.map((column, c) => {
        const label = column.label || [column.name];
        const content = rows.length > 1 && label.some((part) => part !== "") ? h("button", {type: "button", title: "Sort", onclick: () => sort(c)}, ...label) : h("span", {}, ...label);
        return h("th", {scope: "col", class: classOf(column)}, content);
    });
    const shownRows = () => order.filter((k) => !options.isShown || options.isShown(k));
    const draw = () => fill(body, ...shownRows().map((k) => rowOf(options, k)));
    const sort = (column: number) => {
        direction = sorted === column ? -direction : 1;
        sorted = column;
        order = rows.map((_, k) => k).sort((i, j) => (hasTotal ? Number(i === rows.length - 1) - Number(j === rows.length - 1) : 0) || direction * compare(rows[i][column], rows[j][column]) || i - j);
        heads.forEach((head, c) => (c === column ? head.setAttribute("aria-sort", direction > 0 ? "ascending" : "descending") : head.removeAttribute("aria-sort")));
        draw();
    };
    draw();
    const save = () => download(`${name.replace(/[^\p{L}\p{N}.-]+/gu, "-")}.csv`, csvText(columns.map((one) => one.name), shownRows().map((k) => rows[k].map(csvCell))));
    return h("div", {class: options.isStacked ? "table stacked" : "table", onfilter: draw}, h("button", {type: "button", class: "save", onclick: save, title: "Save this table as CSV"}, "CSV"),
        h("div", {class: "scroll", tabindex: 0, role: "region", "aria-label": name}, h("table", {}, h("thead", {}, h("tr", {}, ...heads)), body)));
}

function rowOf({columns, rows, rowClass}: TableOptions, k: number): HTMLTableRowElement {
    return h("tr", {class: rowClass ? rowClass(k) : ""}, ...columns.map((column, c) => {
        const value = rows[k][c], content = column.show ? column.show(value, k) : [cellText(value, column.decimals)];
        return c === 0 ? h("th", {scope: "row", class: column.class}, ...content) : h("td", {class: classOf(column), "data-head": column.name}, ...content);
    }));
}

const classOf = ({isNumber, class: own}: Column) => [isNumber ? "number" : "", own || ""].join(" ").trim();

const csvCell = (value: Cell) => (value === null || value === undefined ? null : typeof value === "number" ? value : Array.isArray(value) ? cellText(value) : String(value));

/// Order of two cells: numbers by value, a mean by its value, other cells as text; empty cells come last.
function compare(one: Cell, other: Cell): number {
    const key = (value: Cell): number | string | null => (Array.isArray(value) ? key(value[0]) : value === null || value === undefined ? null : typeof value === "number" ? value : String(value));
    const [a, b] = [key(one), key(other)];
    if (a === null || b === null) return Number(a === null) - Number(b === null);
    return typeof a === "number" && typeof b === "number" ? a - b : String(a).localeCompare(String(b), undefined, {numeric: true});
}
