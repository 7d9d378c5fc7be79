"use strict";
// Builds the page of a skin: maps, plots over time with a common cursor, first spikes, tables.

const skin = new Skin(JSON.parse(document.getElementById("data").textContent));
const at = (id) => document.getElementById(id);
const view = new SkinView({span: at("span"), now: at("now")});
const scene = new Scene(skin);
const player = new Player(view, skin.marks.width, at);
// `mode` and `frames` are set by chooseMode(). `maxRates` are the rates (Hz) at the upper end of each class's colour scale. `region` is that of the
// rasters: an index, or "all".
const shown = {mode: "", frames: 1, maxRates: [], region: "all"};
const totals = skin.marks.totals();  // spikes of each mark in the recording

function showHeading({title, program, command, notes, summary}) {
    at("title").textContent = title;
    at("program").textContent = program;
    at("command").textContent = command;
    at("description").textContent = [summary.input.description, summary.input.contact].filter((text, k, all) => text && all.indexOf(text) === k).join("; ");
    at("notes").hidden = !notes.length;
    at("notes").innerHTML = notes.map((text) => `<li>${escaped(text)}</li>`).join("");
}

/// Selects a mark, which is under the pointer on a map or in a raster; null selects none.
function selectMark(mark) {
    if (mark === scene.chosen) return;
    scene.chosen = mark;
    showMark();
    scene.request();
}

/// Shows name, region, rate, number of spikes and first spike of the selected mark.
function showMark() {
    const mark = scene.chosen;
    if (mark === null) return void (at("unit").textContent = "");
    const rate = rateOf(mark, skin.recent(scene.frame, shown.frames).counts[mark], skin.lengthOver(scene.frame, shown.frames)), first = skin.firstSpikes[mark];
    at("unit").textContent = `${skin.markName(mark)}, ${skin.regionName(mark)}: ${quantity(rate, "Hz", true)} now, ` +
        `${totals[mark]} spikes${Number.isNaN(first) ? "" : `, the first at ${timeText(skin.t0 + first, 1e-4)}`}`;
}

function connect() {
    scene.onPoint = selectMark;
    view.onMove = (t) => {
        player.follow(t);
        if (scene.frame === skin.frameAt(t)) return;
        scene.frame = skin.frameAt(t);
        showMark();
        scene.request();
    };
    at("earlier").onclick = () => view.pan(-0.25);
    at("later").onclick = () => view.pan(0.25);
    at("in").onclick = () => view.zoom(0.5);
    at("out").onclick = () => view.zoom(2);
    at("reset").onclick = () => view.reset();
    at("autoscale").onchange = () => { view.autoscale = at("autoscale").checked; view.request(); };
    at("mode").onchange = () => { chooseMode(at("mode").value); rateCaptions(); scene.request(); };
    at("map-in").onclick = () => scene.zoom(1 / 1.5);
    at("map-out").onclick = () => scene.zoom(1.5);
    const regions = mapRegions();
    at("view").innerHTML = regions.map(([name], k) => `<option value="${k}">${escaped(name)}</option>`).join("");
    at("view").onchange = () => scene.show(regions[at("view").value][1]);
    const {rates} = skin.data.summary, rateRegions = [...new Set(rates.map(({region}) => region))];
    at("of-region").innerHTML = rateRegions.map((name) => `<option>${escaped(name)}</option>`).join("");
    at("of-region").parentElement.hidden = rateRegions.length < 2;
    at("of-region").onchange = () => showSkinRates(skin, document.querySelector("#rates .scroll"), at("of-region").value);
    connectKeys(view);
    connectPlayKeys();
    new ResizeObserver(() => scene.layOut(at("maps").clientWidth)).observe(at("maps"));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
    addEventListener("beforeprint", () => setPrinting(true));
    addEventListener("afterprint", () => setPrinting(false));
}

/// Space plays or pauses; comma and full stop step one frame back or forward.
function connectPlayKeys() {
    const keys = {" ": () => player.toggle(), ",": () => player.nudge(-1), ".": () => player.nudge(1)};
    document.addEventListener("keydown", (event) => {
        if (event.target.closest("select, button, [role=region]") || event.ctrlKey || event.altKey || event.metaKey || !keys[event.key]) return;
        event.preventDefault();
        keys[event.key]();
    });
}

function setPrinting(on) {
    document.documentElement.classList.toggle("printing", on);
    draw();
}

/// Draws everything that uses colours; called again when the theme changes.
function draw() {
    makeMaps();
    makePanels();
    showFirstSpikes(skin, document.querySelector("#firsts .scroll"));
    showClasses(skin, document.querySelector("#classes .scroll"));
    showDensities(skin, document.querySelector("#classes .densities"));
    showParameters(skin.classes);
}

/// For tests and the browser's console: the plots by name, the index of the frame that the maps show, and by class the number of marks that fired
/// in the window of its rate map.
window.corpuscle = {
    get charts() { return Object.fromEntries(view.panels.map((one) => [one.name, one.chart])); },
    get frame() { return scene.frame; },
    get playing() { return player.playing; },
    skin, scene, view,
    active: () => Object.fromEntries(scene.maps.filter((map) => map.ofRates).map((map) => [map.skinClass.name, map.active])),
};

showHeading(skin.data);
at("about-maps").textContent = skin.afferentsPerMark > 1 ? `Each mark is a group of ${skin.afferentsPerMark} neighbouring afferents; frames of ${quantity(skin.marks.width, "s", true)}.`
                                                 : `Each mark is an afferent; frames of ${quantity(skin.marks.width, "s", true)}.`;
at("about-skin").textContent = [skin.data.summary.skin.description, `${skin.data.summary.skin.afferents} afferents`, `seed ${skin.data.summary.skin.seed}`].filter(Boolean).join("; ");
showSkinRates(skin, document.querySelector("#rates .scroll"), "all");
showTrials(skin.data.trials, SkinTrialFigure);
showSources(skin, document.querySelector("#classes .sources"));
showVersions(skin.data.versions);
modeOptions();
connect();
draw();
player.start();
view.point(player.timeOf(0));
