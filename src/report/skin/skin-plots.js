"use strict";
// Creates the plots over time of the page: total force, mean rates of the classes, and a raster of each class.

/// A panel of class `kind`.
function panel(kind, options) { return new kind({host: at("figures"), input: skin.input, ...options}); }

function makePanels() {
    const keep = view.panels.length > 0, {over} = skin.data;
    view.clear();
    at("figures").replaceChildren();
    view.labelWidth = 60;
    at("figures").style.setProperty("--left", "66px");
    const force = new Trace(over.force, {t0: over.t0, T: over.T, samples: over.samples});
    const panels = [panel(TracePanel, {traces: [force], name: "force", title: "total force", about: "force", height: 100, named: true,
                                       series: [{label: "force", html: "", color: colour("ink"), width: 1.6}]}),
                    panel(SkinRatePanel, {fine: {frames: skin.perClass, classes: skin.classes}, name: "population", about: "mean rate of the classes", height: 140})];
    rasterBar();
    view.show([...panels, ...skin.classes.flatMap(rasterPanel)], skin.input, keep);
}

/// Adds the selector of the region whose afferents the rasters show, and a note if there are too many spikes to show each.
function rasterBar() {
    const bar = element(at("figures"), "div", "bar");
    const names = [...skin.regions.map((_, r) => r)];
    if (names.length > 1) {
        const label = element(bar, "label", "", "Rasters of ");
        const select = element(label, "select", "", ["all", ...names].map((r) => `<option value="${r}" ${String(r) === shown.region ? "selected" : ""}>${r === "all" ? "all regions" : escaped(skin.regions[r])}</option>`).join(""));
        select.id = "raster-region";
        select.onchange = () => { shown.region = select.value; makePanels(); at("raster-region").focus(); };
    }
    if (!skin.trains) element(bar, "span", "note", `More than ${skin.data.over.max_spikes} spikes: the rasters show counts per frame of the maps (${escaped(quantity(skin.marks.width, "s", true))}).`);
}

/// The raster of class number k: the afferents of the selected region that fired.
function rasterPanel(one, k) {
    const wanted = (mark) => shown.region === "all" || skin.region[mark] === Number(shown.region);
    const common = {skinClass: one, name: `raster ${one.name}`, about: `spikes of ${one.name}`, bottom: k === skin.classes.length - 1, onPoint: (afferent) => selectMark(afferent === null ? null : skin.markOf(afferent))};
    if (!skin.trains) return [shadePanel(one, common, wanted)];
    const all = [];
    for (let t = firstAt(skin.trains.afferent, one.first), end = firstAt(skin.trains.afferent, one.first + one.afferents); t < end; ++t) all.push(t);
    const trains = all.filter((t) => wanted(skin.markOf(skin.trains.afferent[t]))).map((t) => skin.trains.train(t));
    return [panel(SkinRasterPanel, {...common, trains, countText: countText(trains.length, all.length, `${one.afferents} afferents`), height: rasterHeight(trains.length)})];
}

/// The raster of a class if the page does not have all spike times. `wanted(mark)`: true for marks in the selected region.
function shadePanel(one, common, wanted) {
    const [from, to] = skin.marksOf(one), rowOf = new Int32Array(skin.marks.places).fill(-1);
    let rowCount = 0, fired = 0;
    for (let m = from; m < to; ++m) {
        if (totals[m]) ++fired;
        if (totals[m] && wanted(m)) rowOf[m] = rowCount++;
    }
    return panel(SkinShadePanel, {...common, frames: skin.marks, t0: skin.t0, rowOf, rowCount, countText: countText(rowCount, fired, skin.afferentsPerMark > 1 ? `${to - from} groups of ${skin.afferentsPerMark} afferents` : `${one.afferents} afferents`), height: rasterHeight(rowCount)});
}

/// The number of rows of a raster, as a text for its title. `fired`: number of afferents or groups of the class that fired; `all`: a text with the
/// number of all of them.
const countText = (rows, fired, all) => (shown.region === "all" ? `${fired} of ${all} fired` : `${rows} of ${fired} that fired, in ${skin.regions[shown.region]}`);
/// Height of a raster with this number of rows, pixels.
const rasterHeight = (rows) => Math.max(30, Math.min(120, 6 * rows), Math.min(180, 40 + 0.6 * rows));
