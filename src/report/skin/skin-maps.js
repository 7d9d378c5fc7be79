"use strict";
// The contents of the maps: rates in a time window, and times of first spikes. Also the regions that can be selected.

/// The rate (Hz) per afferent of a mark with `spikes` spikes in `seconds` seconds.
const rateOf = (mark, spikes, seconds) => spikes / skin.afferentsIn(mark) / seconds;

/// The `values` of a rate map: calls call(mark, level) for each mark that fired in the window. Level 1 is the maximum rate of the class. Also
/// counts these marks for the caption.
function rateValues(map, call) {
    const {skinClass, from, to} = map, isOnMap = (mark) => mark >= from && mark < to;
    map.active = 0;
    const add = (mark, spikes, seconds) => { ++map.active; call(mark, rateOf(mark, spikes, seconds) / shown.maxRates[skinClass.index]); };
    if (shown.mode === "all") for (let m = from; m < to; ++m) { if (totals[m]) add(m, totals[m], skin.duration); }
    else {
        const {counts, activeMarks} = skin.recent(scene.frame, shown.frames);
        for (const mark of activeMarks) if (isOnMap(mark)) add(mark, counts[mark], skin.lengthOver(scene.frame, shown.frames));
    }
    map.count.textContent = `${map.active} active`;
    map.canvas.setAttribute("aria-label", `${skinClass.name}: ${map.active} of ${to - from} active, ${shown.mode === "all" ? "over the recording" : `at ${timeText(skin.t0 + scene.frame * skin.marks.width, skin.marks.width)}`}`);
}

/// Sets what the rate maps show. `mode`: "all" for the mean rate of the recording, else the number of frames of a window that ends at the
/// current time.
function chooseMode(mode) {
    shown.mode = mode;
    shown.frames = mode === "all" ? 1 : Number(mode);
    shown.maxRates = mode === "all" ? skin.classes.map((one) => { const [from, to] = skin.marksOf(one); let max = 0; for (let m = from; m < to; ++m) max = Math.max(max, rateOf(m, totals[m], skin.duration)); return max || 1; })
                                    : skin.maxRates(shown.frames);
}

/// Fills the selector of the mode: windows from one frame to about 0.5 s, and the complete recording. A window of about 0.1 s is preselected.
function modeOptions() {
    const frames = [...new Set([0, 0.05, 0.1, 0.2, 0.5].map((seconds) => skin.framesOver(seconds)))].filter((n) => n < skin.marks.count || n === 1);
    const first = frames.reduce((best, n) => (Math.abs(n - skin.framesOver(0.1)) < Math.abs(best - skin.framesOver(0.1)) ? n : best));
    at("mode").innerHTML = frames.map((n) => `<option value="${n}" ${n === first ? "selected" : ""}>Rate over the last ${quantity(n * skin.marks.width, "s", true)}</option>`).join("") + '<option value="all">Mean rate of the recording</option>';
    chooseMode(String(first));
}

const scaleHtml = (low, high, colours) => `<span class="scale">${low} <span class="ramp" style="background: linear-gradient(to right, ${colours.join(", ")})"></span> ${high}</span>`;

/// Writes the heading of a map: its class and the scale of its colours. `low`, `high`: the values at the ends of the scale, as HTML.
function captionOf(map, low, high, colours) {
    map.caption.innerHTML = `<span class="name">${chipOf(map.skinClass.color)}${escaped(map.skinClass.name)}</span> <span class="unit">${map.skinClass.afferents} afferents</span> ${scaleHtml(low, high, colours)}`;
    map.count = element(map.caption, "span", "readout");
}

/// Writes the headings of all rate maps.
function rateCaptions() {
    for (const map of scene.maps)
        if (map.ofRates) captionOf(map, "0", escaped(quantity(shown.maxRates[map.skinClass.index], "Hz", true)), rateRamp(map.skinClass.color));
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
    at("force-key").innerHTML = skin.data.over.sites.max > 0 ? `${chipOf(colour("force"))} force on ${skin.hasSeparateSites ? "a sensor" : "the skin"}` : "";
    scene.layOut(at("maps").clientWidth);
}

/// Maps of the time of the first spike of each afferent. The colours span the times from the earliest to the 98th percentile.
function makeFirsts(host) {
    const times = Array.from(skin.firstSpikes).filter((t) => !Number.isNaN(t)).sort((a, b) => a - b);
    const active = Object.fromEntries(skin.data.summary.rates.filter(({region, phase}) => region === "all" && phase === "all").map((row) => [row.afferent, row.active]));
    at("about-firsts").textContent = `${Object.values(active).reduce((sum, n) => sum + n, 0)} of ${skin.data.summary.skin.afferents} afferents fired`;
    if (!times.length) return;
    const from = times[0], to = times[Math.floor(0.98 * (times.length - 1))], span = to - from || 1;
    const values = (map, call) => { for (let m = map.from; m < map.to; ++m) if (!Number.isNaN(skin.firstSpikes[m])) call(m, (skin.firstSpikes[m] - from) / span); };
    for (const one of skin.classes) {
        const map = new SkinMap(host, scene, one, {values, ramp: timeRamp, force: () => false});
        captionOf(map, escaped(timeText(skin.t0 + from, span / 100)), escaped(timeText(skin.t0 + to, span / 100)), timeRamp());
        map.count.textContent = `${active[one.name]} fired`;
        map.root.dataset.map = `first ${one.name}`;
        map.canvas.setAttribute("aria-label", `first spike of each ${one.name} afferent`);
    }
}

/// The regions to which the maps can be zoomed: [name, bounding box (mm)] of each.
function mapRegions() {
    const pressed = new Uint8Array(skin.sitePositions.length / 2);
    skin.siteForce.place.forEach((p) => pressed.fill(1, p * skin.sitesPerMark, (p + 1) * skin.sitesPerMark));
    const regions = [["complete skin", scene.all]], grow = (box) => grown(box, Math.max(2 * skin.side, 0.15 * Math.max(box[2] - box[0], box[3] - box[1])));
    if (pressed.includes(1) && pressed.includes(0)) regions.push(["touched area", grow(extentOfPlaces(skin.sitePositions, (s) => pressed[s]))]);
    if (skin.regions.length > 1) skin.regions.forEach((name, r) => regions.push([name, grow(extentOfPlaces(skin.sitePositions, (s) => skin.siteRegion[s] === r))]));
    return regions.filter(([, box]) => box.every(Number.isFinite));
}
