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

const rateOf = (mark, spikes, seconds) => spikes / skin.unitsOf(mark) / seconds;  // of one unit

/// Rates of a class as levels 0 ... 1 for its map.
function rateValues(map, call) {
    const {one, from, to} = map, mine = (mark) => mark >= from && mark < to;
    map.active = 0;
    const tell = (mark, spikes, seconds) => { ++map.active; call(mark, rateOf(mark, spikes, seconds) / shown.most[one.index]); };
    if (shown.mode === "all") for (let m = from; m < to; ++m) { if (totals[m]) tell(m, totals[m], skin.duration); }
    else {
        const {counts, some} = skin.recent(scene.frame, shown.frames);
        for (const mark of some) if (mine(mark)) tell(mark, counts[mark], skin.lengthOver(scene.frame, shown.frames));
    }
    map.count.textContent = `${map.active} active`;
    map.canvas.setAttribute("aria-label", `${one.name}: ${map.active} of ${to - from} active, ${shown.mode === "all" ? "over all" : `at ${timeText(skin.t0 + scene.frame * skin.marks.width, skin.marks.width)}`}`);
}

/// What the maps show: the rate over some time up to now, or over all.
function chooseMode(mode) {
    shown.mode = mode;
    shown.frames = mode === "all" ? 1 : Number(mode);
    shown.most = mode === "all" ? skin.classes.map((one) => { const [from, to] = skin.marksOf(one); let most = 0; for (let m = from; m < to; ++m) most = Math.max(most, rateOf(m, totals[m], skin.duration)); return most || 1; })
                                : skin.greatest(shown.frames);
}

/// From one frame to about half a second, and all; at first about a tenth of a second.
function modeOptions() {
    const frames = [...new Set([0, 0.05, 0.1, 0.2, 0.5].map((seconds) => skin.framesOver(seconds)))].filter((n) => n < skin.marks.count || n === 1);
    const first = frames.reduce((best, n) => (Math.abs(n - skin.framesOver(0.1)) < Math.abs(best - skin.framesOver(0.1)) ? n : best));
    at("mode").innerHTML = frames.map((n) => `<option value="${n}" ${n === first ? "selected" : ""}>rate over the last ${quantity(n * skin.marks.width, "s", true)}</option>`).join("") + '<option value="all">mean rate over all</option>';
    chooseMode(String(first));
}

const scaleHtml = (low, high, colours) => `<span class="scale">${low} <span class="ramp" style="background: linear-gradient(to right, ${colours.join(", ")})"></span> ${high}</span>`;

/// A map's heading: whose it is, what its colours mean.
function captionOf(map, low, high, colours) {
    map.caption.innerHTML = `<span class="name">${chipOf(map.one.color)}${escaped(map.one.name)}</span> <span class="unit">${map.one.units} units</span> ${scaleHtml(low, high, colours)}`;
    map.count = element(map.caption, "span", "readout");
}

function rateCaptions() {
    for (const map of scene.maps)
        if (map.ofRates) captionOf(map, "0", escaped(quantity(shown.most[map.one.index], "Hz", true)), rateRamp(map.one.color));
}

function makeMaps() {
    scene.maps = [];
    const [rates, firsts] = [document.querySelector("#maps .row"), document.querySelector("#firsts .row")];
    [rates, firsts].forEach((host) => host.replaceChildren());
    for (const one of skin.classes) {
        const map = new SkinMap(rates, scene, one, {values: rateValues, ramp: rateRamp, force: () => shown.mode !== "all"});
        map.ofRates = true;
    }
    rateCaptions();
    makeFirsts(firsts);
    at("force-key").innerHTML = skin.data.over.sites.greatest > 0 ? `${chipOf(colour("force"))} force on ${skin.standsAlone ? "a sensor" : "the skin"}` : "";
    scene.layOut(at("maps").clientWidth);
}

/// Maps of when each unit fired first; times run from the earliest to the latest of 98 in 100 units.
function makeFirsts(host) {
    const times = Array.from(skin.first).filter((t) => !Number.isNaN(t)).sort((a, b) => a - b);
    const active = Object.fromEntries(skin.data.summary.rates.filter(({region, phase}) => region === "all" && phase === "all").map((row) => [row.afferent, row.active]));
    at("about-firsts").textContent = `${Object.values(active).reduce((sum, n) => sum + n, 0)} of ${skin.data.summary.skin.units} units fired`;
    if (!times.length) return;
    const from = times[0], to = times[Math.floor(0.98 * (times.length - 1))], span = to - from || 1;
    const values = (map, call) => { for (let m = map.from; m < map.to; ++m) if (!Number.isNaN(skin.first[m])) call(m, (skin.first[m] - from) / span); };
    for (const one of skin.classes) {
        const map = new SkinMap(host, scene, one, {values, ramp: timeRamp, force: () => false});
        captionOf(map, escaped(timeText(skin.t0 + from, span / 100)), escaped(timeText(skin.t0 + to, span / 100)), timeRamp());
        map.count.textContent = `${active[one.name]} fired`;
        map.root.dataset.map = `first ${one.name}`;
        map.canvas.setAttribute("aria-label", `first spike of each unit of ${one.name}`);
    }
}

/// The parts of the skin that can fill the maps.
function partsOf() {
    const pressed = new Uint8Array(skin.sitePlaces.length / 2);
    skin.siteForce.place.forEach((p) => pressed.fill(1, p * skin.sitesTogether, (p + 1) * skin.sitesTogether));
    const parts = [["whole skin", scene.all]], grow = (box) => grown(box, Math.max(2 * skin.side, 0.15 * Math.max(box[2] - box[0], box[3] - box[1])));
    if (pressed.includes(1) && pressed.includes(0)) parts.push(["where it is touched", grow(extentOfPlaces(skin.sitePlaces, (s) => pressed[s]))]);
    if (skin.regions.length > 1) skin.regions.forEach((name, r) => parts.push([name, grow(extentOfPlaces(skin.sitePlaces, (s) => skin.siteRegion[s] === r))]));
    return parts.filter(([, box]) => box.every(Number.isFinite));
}

function panel(kind, options) { return new kind({host: at("figures"), input: skin.input, ...options}); }

function makePanels() {
    const keep = view.panels.length > 0, {over} = skin.data;
    view.clear();
    at("figures").replaceChildren();
    view.labelWidth = 60;
    at("figures").style.setProperty("--left", "66px");
    const force = new Trace(over.force, {t0: over.t0, T: over.T, samples: over.samples});
    const panels = [panel(TracePanel, {traces: [force], name: "force", title: "force of all sites", about: "force", height: 100, named: true,
                                       series: [{label: "force", html: "", color: colour("ink"), width: 1.6}]}),
                    panel(SkinRatePanel, {fine: {frames: skin.perClass, classes: skin.classes}, name: "population", about: "rate of the classes", height: 140})];
    rasterBar();
    view.show([...panels, ...skin.classes.flatMap(rasterPanel)], skin.input, keep);
}

/// Which region's units the rasters show; where there are too many spikes, what they show instead.
function rasterBar() {
    const bar = element(at("figures"), "div", "bar");
    const names = [...skin.regions.map((_, r) => r)];
    if (names.length > 1) {
        const label = element(bar, "label", "", "rasters of ");
        const select = element(label, "select", "", ["all", ...names].map((r) => `<option value="${r}" ${String(r) === shown.region ? "selected" : ""}>${r === "all" ? "all regions" : escaped(skin.regions[r])}</option>`).join(""));
        select.id = "raster-region";
        select.onchange = () => { shown.region = select.value; makePanels(); at("raster-region").focus(); };
    }
    if (!skin.trains) element(bar, "span", "note", `More than ${skin.data.over.most_spikes} spikes: the rasters show how many there are in each frame of the maps, ${escaped(quantity(skin.marks.width, "s", true))}.`);
}

function rasterPanel(one, k) {
    const wanted = (mark) => shown.region === "all" || skin.region[mark] === Number(shown.region);
    const common = {one, name: `raster ${one.name}`, about: `spikes of ${one.name}`, region: skin.regions[shown.region], bottom: k === skin.classes.length - 1, pointed: (unit) => pointAt(unit === null ? null : skin.markOf(unit))};
    if (!skin.trains) return [shadePanel(one, common, wanted)];
    const own = [];
    for (let t = firstAt(skin.trains.unit, one.first), end = firstAt(skin.trains.unit, one.first + one.units); t < end; ++t) own.push(t);
    const trains = own.filter((t) => wanted(skin.markOf(skin.trains.unit[t]))).map((t) => skin.trains.train(t));
    return [panel(SkinRasterPanel, {...common, trains, fired: own.length, height: rasterHeight(trains.length)})];
}

function shadePanel(one, common, wanted) {
    const [from, to] = skin.marksOf(one), rowOf = new Int32Array(skin.marks.places).fill(-1);
    let rowCount = 0, fired = 0;
    for (let m = from; m < to; ++m) {
        if (totals[m]) ++fired;
        if (totals[m] && wanted(m)) rowOf[m] = rowCount++;
    }
    return panel(SkinShadePanel, {...common, frames: skin.marks, t0: skin.t0, rowOf, rowCount, fired, height: rasterHeight(rowCount)});
}

const rasterHeight = (rows) => Math.max(30, Math.min(180, 40 + rows * 0.6));

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
// The first picture: where most happens.
const busiest = Array.from({length: skin.marks.count}, (_, f) => skin.marks.begin[f + 1] - skin.marks.begin[f]).reduce((best, n, f, all) => (n > all[best] ? f : best), 0);
view.point(player.timeOf(busiest));
