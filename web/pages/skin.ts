// The page of a skin: maps with a player, plots over time, first spikes, tables.

import {h} from "../base/dom";
import {linkNumber, linkValues, setLink} from "../base/link";
import type {SkinPageData} from "../data/skin";
import {View} from "../plot/view";
import {showVersions, startPage} from "../shell";
import {Player} from "../skin/player";
import {SkinRecording} from "../skin/recording";
import {SkinMaps} from "./skin-maps";
import {SkinPlots} from "./skin-plots";
import {showTrials} from "./skin-trials";
import {showClasses, showFirstTable, showParameters, showRates} from "./skin-tables";

export function showSkinPage(data: SkinPageData) {
    const main = startPage(data), skin = new SkinRecording(data), view = new View();
    document.body.classList.add("skin");
    view.setLimits({begin: skin.clock.t0, end: skin.end, smallest: 4 * skin.clock.T});
    view.point(skin.clock.t0);
    const player = new Player(view, skin.marks.width), link = () => setLink(linkOf());
    main.append(player.root);
    const maps = new SkinMaps(main, skin, view, link);
    main.append(h("p", {class: "hint"}, h("span", {class: "for-mouse"}, "Maps: drag to pan, Ctrl and the wheel to zoom, double click to reset. Space plays, comma and full stop step."),
        h("span", {class: "for-touch"}, "Swipe to the next map. Pinch to zoom a map, tap an afferent to name it.")));
    const plots = new SkinPlots(main, skin, view, (mark) => maps.choose(mark), link);
    showFirstTable(maps.addFirstSpikes(main), skin);
    showRates(main, skin);
    const trials = showTrials(main, skin);
    showClasses(main, skin);
    showParameters(main, skin);
    showVersions(main, data.versions);

    const linkOf = () => ({t: view.cursor === null || view.cursor === view.begin ? null : +view.cursor.toPrecision(7), from: view.isComplete ? null : +view.a.toPrecision(7), to: view.isComplete ? null : +view.b.toPrecision(7),
                           show: maps.mode === maps.modes[0] ? null : maps.mode.key, region: maps.region ? maps.regions[maps.region][0] : null, rasters: plots.regionName});
    restore(view, maps, plots);
    let waiting = 0;
    const later = () => {
        clearTimeout(waiting);
        waiting = window.setTimeout(() => player.isPlaying || link(), 200);
    };
    view.onDraw(later);
    view.onCursor(later);
    // for tests and the browser's console
    Object.assign(window, {corpuscle: {skin, view, player, maps, scene: maps.scene, get panels() { return Object.fromEntries([...view.panels, ...(trials ? trials.view.panels : [])].map((one) => [one.name, one])); },
                                       get frame() { return skin.frameAt(maps.time); }, get active() { return maps.active; }}});
}

/// Shows what the link says. A damaged link, or a value that does not exist, is ignored.
function restore(view: View, maps: SkinMaps, plots: SkinPlots) {
    const values = linkValues();
    if (!values) return;
    const [t, from, to] = ["t", "from", "to"].map((name) => linkNumber(values.get(name)));
    const mode = maps.modes.findIndex(({key}) => key === values.get("show")), region = maps.regions.findIndex(([name]) => name === values.get("region"));
    if (mode > 0) maps.setMode(mode);
    if (region > 0) maps.setRegion(region);
    plots.setRegion(values.get("rasters"));
    if (from !== null && to !== null && from < to) view.set(from, to);
    if (t !== null) view.point(t);
}

