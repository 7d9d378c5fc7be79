// The figures of the live page: force, spikes of the rows, spikes of the skin, and on demand the probes of a row.

import {classColour, mixed} from "../base/colours";
import {symbol} from "../base/text";
import {RasterPanel, Row as RasterRow} from "../panels/raster-panel";
import {TracePanel} from "../panels/trace-panel";
import {View} from "../plot/view";
import type {LiveCurve} from "./history";
import type {Row, Skin} from "./session";

const SPAN = 5;  // s that are visible while the page follows the present

/// A trace panel whose vertical axis grows with its curves.
class LivePanel extends TracePanel {
    protected range(isAutoscale: boolean): [number, number] {
        const ends = this.traces.flatMap((trace) => trace.fullRange()).filter((v): v is number => v !== null);
        this.setExtent(ends.length ? [Math.min(...ends, this.traces[0].unit === "N" ? 0 : Infinity), Math.max(...ends)] : [0, 1]);
        return super.range(isAutoscale);
    }
}

/// The data of the figures: of a session, or of a stream.
export interface LiveSource { rows: Row[]; skin: Skin | null; force: LiveCurve; time: number; changes: number }  // changes: of the data, so far

export class Charts {
    readonly view = new View();
    private isFollowing = true;
    private shown: [number, number] = [0, SPAN];  // set by follow(); another range was chosen by the user
    private drawn = -1;  // changes of the data that follow() has shown

    constructor(private session: LiveSource, private host: HTMLElement) {
        this.view.setLimits({begin: 0, end: SPAN, smallest: 0.01});
    }

    /// Builds the panels anew, after a start.
    renew() {
        const {session, host, view} = this, common = {clock: session.force.clock, phases: []};
        view.clear();
        view.add(new LivePanel({host, name: "force", title: ["force"], about: "force", height: 90, traces: [session.force], series: [{name: "force", label: [], colour: "var(--ink)", width: 1.8}], ...common}));
        const rows: RasterRow[] = session.rows.map(({info, train, colour}, k) => ({series: info.name, label: info.name, colour, spikes: train, about: `row ${k + 1}, ${info.name}`}));
        if (rows.length)
            view.add(new RasterPanel({host, name: "rows", title: ["spikes of single afferents under the whole force"], about: "spikes of the rows", height: Math.max(50, 24 * rows.length), rows,
                                      series: [], isBottom: !session.skin, ...common}));
        if (session.skin) view.add(this.skinRaster());
        [this.isFollowing, this.shown, this.drawn] = [true, [0, SPAN], -1];
        view.setLimits({begin: 0, end: SPAN, smallest: 0.01});
    }

    private skinRaster(): RasterPanel {
        const {classes, trains, population} = this.session.skin!;
        const rows = classes.flatMap(({name, first, count}) => {
            const offset = first - this.session.rows.length;
            return Array.from({length: count}, (_, k) => ({series: name, label: `${name}#${k + 1}`, colour: classColour(name), spikes: trains[offset + k], group: name}));
        });
        return new RasterPanel({host: this.host, name: "skin", title: [`spikes: ${population.replace(/,/g, ", ")}`], about: "spikes of the skin", height: 210, rows, isGrouped: true, isBottom: true,
                                series: classes.map(({name}) => ({name, colour: classColour(name), width: 3})), clock: this.session.force.clock, phases: []});
    }

    /// Shows the last seconds, unless the user has chosen another range. Draws only if the data or the range have changed.
    follow() {
        const {view, session} = this, end = Math.max(session.time, SPAN), hasMoved = view.a !== this.shown[0] || view.b !== this.shown[1];
        if (!hasMoved && session.changes === this.drawn) return;
        this.drawn = session.changes;
        if (hasMoved) this.isFollowing = view.b >= view.end - 1e-9;
        const length = view.b - view.a;
        view.setLimits({begin: Math.max(0, end - 60), end, smallest: 0.01}, true);
        if (this.isFollowing) view.set(end - length, end);
        this.shown = [view.a, view.b];
    }

    followAgain() {
        this.view.set(this.view.end - SPAN, this.view.end);
        this.shown = [this.view.a, this.view.b];
        this.isFollowing = true;
    }

    /// Panels of the probes of a row, one for each unit, in a host of their own. Returns a function that removes them.
    showProbes(row: Row, host: HTMLElement): () => void {
        const units = new Map<string, LiveCurve[]>();
        for (const curve of row.curves) units.set(curve.unit, [...(units.get(curve.unit) || []), curve]);
        const panels = Array.from(units, ([unit, curves]) => new LivePanel({
            host, name: `${row.info.name} ${unit}`, title: [{A: "currents", V: "voltages"}[unit] || curves.map(({quantity}) => quantity).join(", ")], about: `${row.info.name}, probes in ${unit}`, height: 110,
            isBottom: true, clock: this.session.force.clock, phases: [], traces: curves,
            series: curves.map(({quantity}, k) => ({name: quantity, label: symbol(quantity), colour: mixed(row.colour, "var(--ink)", k / Math.max(curves.length, 1)), dash: k % 2 ? [6, 3] : undefined})),
        }));
        this.view.add(...panels);
        return () => {
            this.view.panels = this.view.panels.filter((one) => !panels.includes(one as LivePanel));
            panels.forEach((panel) => panel.remove());
        };
    }
}
