// Access to the page for tests and the browser's console: window.corpuscle.

import type {Trace} from "../../panels/signals";
import type {View} from "../../plot/view";

interface Page { views: View[]; view: View; traces: Trace[] }

///   panels                 by name: "force", "all forces", "raster", "population", "frequency", "sa1 current", "sa1 membrane", "trial raster".
///                          With several implementations the names are "sa1 I", "sa1 I_A", "sa1 u", "sa1 frequency"
///   valueAt(quantity, t, afferent)   the value on the chosen channel at the sample nearest to t. It is [min, max] if the trace has only the minimum
///                          and maximum of several samples, and null if there is no such trace. "force" has no afferent
///   window(), setWindow(a, b)   the visible times (s); setting them redraws at once
///   pointsDrawn()          by panel: the points of its longest curve, and the width of its plot in pixels
export function consoleAccess(page: Page) {
    const {view} = page, all = () => page.views.flatMap(({panels}) => panels);
    return {
        get panels() { return Object.fromEntries(all().map((panel) => [panel.name, panel])); },
        valueAt(quantity: string, t: number, afferent: string | null = null) {
            const trace = page.traces.find((one) => one.quantity === quantity && one.afferent === afferent);
            return trace ? (trace.bucket === 1 ? trace.at(t)[0] : trace.at(t)) : null;
        },
        window: () => [view.a, view.b],
        setWindow(a: number, b: number) {
            view.set(a, b);
            view.draw();
        },
        pointsDrawn: () => Object.fromEntries(all().map(({name, drawn, area}) => [name, {rows: drawn, width: area.w}])),
    };
}
