"use strict";
// What the maps of the page show: rates over some time, first spikes; and which parts of the skin fill them.

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
