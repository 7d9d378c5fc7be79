// The page of a fitted transistor: its values with intervals, then measured points, computed curves, and their differences.

import {h} from "../base/dom";
import {label} from "../base/label";
import {expose} from "../base/panels";
import type {TransistorData} from "../data/study";
import {plotPanel} from "../panels/plots";
import {table} from "../panels/table";
import {section, showVersions, startPage} from "../shell";

export function showTransistorPage(data: TransistorData) {
    const main = startPage({...data, notes: data.fit.notes}), {parameters} = data.fit;
    const values = section(main, "values", "Values", data.misfit);
    values.append(table({name: "values of the transistor", isStacked: true,
        columns: [{name: "parameter", show: (value) => label(String(value))}, {name: "card"}, {name: "value", isNumber: true, show: (_, k) => [parameters[k].text]},
                  {name: "95 % interval", show: (_, k) => [parameters[k].interval]}, {name: "unit", class: "file-only"}, {name: "remark", class: "unit reason"}],
        rows: parameters.map(({name, card, value, low, high, unit, not_determined: remark}) => [name, card, value, low === null || high === null ? null : [low, high], unit, remark ?? ""])}));
    const figures = h("div", {class: "columns"});
    section(main, "curves", "Curves and differences").append(figures);
    expose(...data.plots.map((plot, k) => plotPanel(figures, plot, `${k + 1} `)));
    if (data.versions) showVersions(main, data.versions);
}
