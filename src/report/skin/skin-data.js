"use strict";
// Decodes the data of a skin page: positions, afferents, marks, frames, spike trains.

/// Reads variable-length integers (LEB128): seven bits per byte, the lowest bits first; the byte's highest bit is set if more bytes follow.
class PackedNumbers {
    constructor(base64) { Object.assign(this, {bytes: bytesOf(base64), at: 0}); }

    next() {
        for (let n = 0, scale = 1;; scale *= 128) {
            const byte = this.bytes[this.at++];
            n += (byte & 127) * scale;
            if (byte < 128) return n;
        }
    }
}

/// The nonzero values at many places (marks of afferents, marks of sites, or classes) in each frame. Frame f has entries begin[f] ...
/// begin[f + 1] - 1 of the arrays `place` (ascending within a frame) and `value`. `width`: length of a frame, s.
class Frames {
    constructor({count, width, places, data}) {
        Object.assign(this, {count, width, places, begin: new Uint32Array(count + 1)});
        const source = new PackedNumbers(data), place = [], value = [];
        for (let f = 0; f < count; ++f) {
            for (let p = 0; p < places;) {
                const byte = source.bytes[source.at++];
                if (byte === 0) p += source.next();
                else place.push(p++), value.push(byte < 255 ? byte : source.next());
            }
            this.begin[f + 1] = place.length;
        }
        Object.assign(this, {place: Uint32Array.from(place), value: Uint32Array.from(value)});
    }

    /// Calls `call(place, value)` for each nonzero value of a frame.
    each(frame, call) {
        for (let k = this.begin[frame]; k < this.begin[frame + 1]; ++k) call(this.place[k], this.value[k]);
    }

    /// The sum of the values of each place over all frames.
    totals() {
        const sums = new Float64Array(this.places);
        this.place.forEach((p, k) => { sums[p] += this.value[k]; });
        return sums;
    }
}

/// The spike trains of the afferents that fired, in order of the afferents. Train k belongs to afferent `afferent[k]`; its spike times (s) are
/// times[begin[k]] ... times[begin[k + 1] - 1]. `tick`: unit of the packed times, s.
class Trains {
    constructor({count, trains, tick, data}, t0) {
        const source = new PackedNumbers(data);
        Object.assign(this, {afferent: new Uint32Array(trains), begin: new Uint32Array(trains + 1), times: new Float64Array(count)});
        for (let k = 0, afferent = 0, at = 0; k < trains; ++k) {
            afferent += source.next();
            this.afferent[k] = afferent++;
            const end = at + source.next();
            for (let ticks = 0; at < end; ++at) this.times[at] = t0 + (ticks += source.next()) * tick;
            this.begin[k + 1] = end;
        }
    }

    /// Train k as an object that countPerColumn() in page-raster.js can count.
    train(k) {
        const times = this.times.subarray(this.begin[k], this.begin[k + 1]);
        return {afferent: this.afferent[k], times, before: (t) => firstAt(times, t)};
    }
}

/// The number of elements of an ascending array that are smaller than t.
function firstAt(times, t) {
    let low = 0, high = times.length;
    while (low < high) {
        const middle = (low + high) >> 1;
        if (times[middle] < t) low = middle + 1;
        else high = middle;
    }
    return low;
}

/// The decoded data of the page. Positions are arrays x, y, x, y ... in mm. A mark is a dot of a map: an afferent, or a group of neighbouring
/// afferents of one class. Likewise, the force is that of marks of sitesPerMark neighbouring sites.
class Skin {
    constructor(data) {
        const {over, marks, sites} = data;
        Object.assign(this, {data, regions: data.regions, t0: over.t0});
        const overall = (name) => data.summary.rates.find(({afferent, region, phase}) => afferent === name && region === "all" && phase === "all");
        this.classes = data.classes.map((one, index) => ({...one, index, active: overall(one.name).active, get color() { return afferentColour(index); }}));
        this.input = {t0: over.t0, T: over.T, samples: over.shown_samples, phases: data.summary.input.phases.map(({name, from_s, to_s}) => ({name, from: over.t0 + from_s, to: over.t0 + to_s}))};
        this.markPositions = floats(marks.places);
        // of each mark: index of its region, and number of its first afferent within its class, from 1
        this.region = new Uint16Array(bytesOf(marks.region).buffer);
        this.copy = new Uint32Array(bytesOf(marks.copy).buffer);
        this.firstSpikes = floats(marks.first);  // time of the first spike of each mark, s after t0; NaN if it did not fire
        // index of the first afferent of each mark, then the number of afferents
        this.firstAfferents = new Uint32Array(bytesOf(marks.begin).buffer);
        this.sitePositions = floats(sites.places);
        this.siteRegion = new Uint16Array(bytesOf(sites.region).buffer);
        this.siteForce = new Frames(over.sites);
        this.marks = new Frames(over.marks);
        this.afferentsPerMark = over.afferents_per_mark;
        this.sitesPerMark = over.sites_per_mark;
        // Side of a site's square, mm. Sites without an area are drawn as separate squares.
        this.side = sites.side || spacing(this.sitePositions) * 0.9;
        this.hasSeparateSites = !sites.side;
        this.perClass = new Frames(over.classes);  // spike counts of the classes
    }

    /// The spike trains, decoded at the first use; null if the page does not have them.
    get trains() {
        if (!this.decoded && this.data.over.spikes) this.decoded = new Trains(this.data.over.spikes, this.t0);
        return this.decoded || null;
    }

    /// The index of the mark of an afferent. Name and region of a mark are those of its first afferent.
    markOf(afferent) { return firstAt(this.firstAfferents, afferent + 1) - 1; }
    classOf(mark) { return this.classes.find(({first, afferents}) => this.firstAfferents[mark] >= first && this.firstAfferents[mark] < first + afferents); }
    markName(mark) { return `${this.classOf(mark).name}#${this.copy[mark]}${this.afferentsIn(mark) > 1 ? ` and ${this.afferentsIn(mark) - 1} neighbours` : ""}`; }
    regionName(mark) { return this.regions[this.region[mark]]; }
    /// Duration of the response, s.
    get duration() { return this.input.samples * this.input.T; }

    /// The indices of the marks of a class: [first, end).
    marksOf({first, afferents}) { return [firstAt(this.firstAfferents, first), firstAt(this.firstAfferents, first + afferents)]; }
    afferentsIn(mark) { return this.firstAfferents[mark + 1] - this.firstAfferents[mark]; }

    /// The number of frames in about `seconds`, at least 1.
    framesOver(seconds) { return Math.max(1, Math.round(seconds / this.marks.width)); }
    /// Total duration (s) of the last `frames` frames up to frame `frame`, inclusive. The first frames have fewer before them, and the last frame of
    /// the recording may be shorter.
    lengthOver(frame, frames) { return Math.min((frame + 1) * this.marks.width, this.duration) - Math.max(0, frame + 1 - frames) * this.marks.width; }

    /// The spikes in the last `frames` frames up to frame `frame`, inclusive: `counts` of all marks, and `activeMarks`, the marks with spikes.
    recent(frame, frames) {
        if (this.cached && this.cached.frame === frame && this.cached.frames === frames) return this.cached;
        const counts = new Uint32Array(this.marks.places), activeMarks = [];
        for (let f = Math.max(0, frame + 1 - frames); f <= frame; ++f)
            this.marks.each(f, (mark, n) => { if (!counts[mark]) activeMarks.push(mark); counts[mark] += n; });
        return (this.cached = {frame, frames, counts, activeMarks});
    }

    /// For each class, the maximum over its marks and over time of the rate per afferent (Hz) in a window of `frames` frames; 1 if no mark fired.
    maxRates(frames) {
        const counts = new Int32Array(this.marks.places), rates = this.classes.map(() => 0), ends = this.classes.map((one) => this.marksOf(one)[1]);
        for (let f = 0; f < this.marks.count; ++f) {
            if (f >= frames) this.marks.each(f - frames, (mark, n) => { counts[mark] -= n; });
            let c = 0;  // each() calls with ascending marks, and the marks of a class are adjacent
            this.marks.each(f, (mark, n) => {
                counts[mark] += n;
                while (mark >= ends[c]) ++c;
                rates[c] = Math.max(rates[c], counts[mark] / this.afferentsIn(mark) / this.lengthOver(f, frames));
            });
        }
        return rates.map((rate) => rate || 1);
    }

    /// The index of the frame at time t, limited to the existing frames.
    frameAt(t) { return Math.max(0, Math.min(this.marks.count - 1, Math.floor((t - this.t0) / this.marks.width + 1e-9))); }
}

/// Decodes base64 of floats.
const floats = (base64) => new Float32Array(bytesOf(base64).buffer);

/// The median distance (mm) of a place to its nearest neighbour, estimated from about 60 places; 5 if there are fewer than two.
function spacing(places) {
    const count = places.length / 2, step = Math.max(1, Math.floor(count / 60)), found = [];
    for (let i = 0; i < count; i += step) {
        let nearest = Infinity;
        for (let j = 0; j < count; ++j)
            if (j !== i) nearest = Math.min(nearest, Math.hypot(places[2 * i] - places[2 * j], places[2 * i + 1] - places[2 * j + 1]) || Infinity);
        found.push(nearest);
    }
    const middle = found.sort((a, b) => a - b)[Math.floor(found.length / 2)];
    return Number.isFinite(middle) ? middle : 5;
}

/// Bounding box [x0, y0, x1, y1] (mm) of the places whose index satisfies `wanted`. Not finite if there are none.
function extentOfPlaces(places, wanted = () => true) {
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    for (let k = 0; 2 * k < places.length; ++k)
        if (wanted(k)) [box[0], box[1], box[2], box[3]] = [Math.min(box[0], places[2 * k]), Math.min(box[1], places[2 * k + 1]), Math.max(box[2], places[2 * k]), Math.max(box[3], places[2 * k + 1])];
    return box;
}
