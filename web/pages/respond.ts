// The page of the verb `respond`: force, spikes and rates, then currents and membranes, then tables.

import {seriesColour} from "../base/colours";
import {RespondData} from "../data/document";
import {RasterPanel, rasterHeight} from "../panels/raster-panel";
import {Spikes, Trace, endOf} from "../panels/signals";
import {TracePanel} from "../panels/trace-panel";
import {View} from "../plot/view";
import {hint, section, showVersions, startPage, timeToolbar} from "../shell";

export function showRespondPage(data: RespondData) {
    const main = startPage(data), view = new View();
    timeToolbar(main, view);
    main.append(hint());
    const input = data.inputs[0], channel = input.channels[0], clock = input, phases = input.phases;
    const traces = data.traces.filter((one) => one.channel === channel.id && one.afferent === null).map((one) => new Trace(one, clock));
    const host = section(main, "stimulus", "Stimulus", input.description);
    view.setLimits({begin: input.t0, end: endOf(input), smallest: 4 * input.T});
    view.add(new TracePanel({host, name: "force", title: ["force"], about: "force", height: 120, phases, isNamed: true, traces,
                             series: traces.map(({quantity}) => ({name: quantity, label: [], colour: "var(--ink)", width: 1.6}))}));
    const rows = data.spikes.filter((one) => one.channel === channel.id).map((one, k) => ({series: one.afferent, label: one.afferent, colour: seriesColour(k), spikes: new Spikes(one)}));
    view.add(new RasterPanel({host: section(main, "spikes", "Spikes"), name: "raster", title: ["spikes"], about: "spikes", height: rasterHeight(rows.length), phases, rows,
                              series: rows.map(({series, colour}) => ({name: series, colour, width: 3})), isBottom: true}));
    showVersions(main, data.versions);
}
