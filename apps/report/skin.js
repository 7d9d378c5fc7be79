"use strict";
// Puts the page of a skin together: maps, plots over time that share its cursor, first spikes, tables.

const skin = new Skin(JSON.parse(document.getElementById("data").textContent));
const at = (id) => document.getElementById(id);
const view = new SkinView({span: at("span"), now: at("now")});
const scene = new Scene(skin);
const player = new Player(view, skin.marks.width, at);
const shown = {mode: "", frames: 1, most: [], region: "all"};
const totals = skin.marks.totals();

function showHeading({title, program, command, remarks, summary}) {
    at("title").textContent = title;
    at("program").textContent = program;
    at("command").textContent = command;
    at("sentence").textContent = [summary.input.sentence, summary.input.contact].filter((text, k, all) => text && all.indexOf(text) === k).join("; ");
    at("remarks").hidden = !remarks.length;
    at("remarks").innerHTML = remarks.map((text) => `<li>${escaped(text)}</li>`).join("");
}

/// A mark that somebody points at, on a map or in a raster.
function pointAt(mark) {
    if (mark === scene.chosen) return;
    scene.chosen = mark;
    tellMark();
    scene.request();
}

function tellMark() {
    const mark = scene.chosen;
    if (mark === null) return void (at("unit").textContent = "");
    const rate = rateOf(mark, skin.recent(scene.frame, shown.frames).counts[mark], skin.lengthOver(scene.frame, shown.frames)), first = skin.first[mark];
    at("unit").textContent = `${skin.markName(mark)}, ${skin.regionName(mark)}: ${quantity(rate, "Hz", true)} now, ` +
        `${totals[mark]} spikes${Number.isNaN(first) ? "" : `, the first at ${timeText(skin.t0 + first, 1e-4)}`}`;
}

function connect() {
    scene.pointed = pointAt;
    view.moved = (t) => {
        player.follow(t);
        if (scene.frame === skin.frameAt(t)) return;
        scene.frame = skin.frameAt(t);
        tellMark();
        scene.request();
    };
    at("earlier").onclick = () => view.pan(-0.25);
    at("later").onclick = () => view.pan(0.25);
    at("in").onclick = () => view.zoom(0.5);
    at("out").onclick = () => view.zoom(2);
    at("whole").onclick = () => view.whole();
    at("fit").onchange = () => { view.fit = at("fit").checked; view.request(); };
    at("mode").onchange = () => { chooseMode(at("mode").value); rateCaptions(); scene.request(); };
    at("map-in").onclick = () => scene.zoom(1 / 1.5);
    at("map-out").onclick = () => scene.zoom(1.5);
    const parts = partsOf();
    at("view").innerHTML = parts.map(([name], k) => `<option value="${k}">${escaped(name)}</option>`).join("");
    at("view").onchange = () => scene.show(parts[at("view").value][1]);
    const {rates} = skin.data.summary, regions = [...new Set(rates.map(({region}) => region))];
    at("of-region").innerHTML = regions.map((name) => `<option>${escaped(name)}</option>`).join("");
    at("of-region").parentElement.hidden = regions.length < 2;
    at("of-region").onchange = () => showSkinRates(skin, document.querySelector("#rates .scroll"), at("of-region").value);
    followKeys(view);
    followPlayKeys();
    new ResizeObserver(() => scene.layOut(at("maps").clientWidth)).observe(at("maps"));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
    addEventListener("beforeprint", () => forPaper(true));
    addEventListener("afterprint", () => forPaper(false));
}

/// Space plays, comma and full stop go a frame back or on.
function followPlayKeys() {
    const keys = {" ": () => player.toggle(), ",": () => player.nudge(-1), ".": () => player.nudge(1)};
    document.addEventListener("keydown", (event) => {
        if (event.target.closest("select, button, [role=region]") || event.ctrlKey || event.altKey || event.metaKey || !keys[event.key]) return;
        event.preventDefault();
        keys[event.key]();
    });
}

function forPaper(on) {
    document.documentElement.classList.toggle("printing", on);
    draw();
}

/// All that has colours; again when they change.
function draw() {
    makeMaps();
    makePanels();
    showFirstSpikes(skin, document.querySelector("#firsts .scroll"));
    showClasses(skin, document.querySelector("#classes .scroll"));
    showDensities(skin, document.querySelector("#classes .densities"));
    showParameters(skin.classes);
}

/// For tests, and for looking at the page from the browser's console: the plots, the maps, and which frame they show.
window.corpuscle = {
    get charts() { return Object.fromEntries(view.panels.map((one) => [one.name, one.chart])); },
    get frame() { return scene.frame; },
    get playing() { return player.playing; },
    skin, scene, view,
    active: () => Object.fromEntries(scene.maps.filter((map) => map.ofRates).map((map) => [map.one.name, map.active])),
};

showHeading(skin.data);
at("about-maps").textContent = skin.together > 1 ? `a mark stands for ${skin.together} units that are neighbours; frames of ${quantity(skin.marks.width, "s", true)}`
                                                 : `a mark is a unit; frames of ${quantity(skin.marks.width, "s", true)}`;
at("about-skin").textContent = [skin.data.summary.skin.sentence, `${skin.data.summary.skin.units} units`, `seed ${skin.data.summary.skin.seed}`].filter(Boolean).join("; ");
showSkinRates(skin, document.querySelector("#rates .scroll"), "all");
showSources(skin, document.querySelector("#classes .sources"));
showVersions(skin.data.versions);
modeOptions();
connect();
draw();
player.start();
view.point(player.timeOf(0));
