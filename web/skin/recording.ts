// The decoded data of the page of a skin: its shape, the force on it, the spikes of its afferents.

import {decoded, firstAt} from "../base/arrays";
import {classColour, seriesColour} from "../base/colours";
import type {SkinPageData} from "../data/skin";
import type {Clock, Phase} from "../panels/signals";
import {Frames, SpikeBins, Train, trainsOf} from "./frames";
import {SkinClass, SkinGeometry, spacing} from "./geometry";

/// `active`: number of its afferents that fired. Afferents first ... first + afferents - 1.
export interface RecordedClass extends SkinClass { afferents: number; active: number; firstAfferent: number }
export interface MarkCounts { counts: Uint32Array; active: number[] }

export class SkinRecording {
    readonly classes: RecordedClass[];
    readonly geometry: SkinGeometry;
    readonly clock: Clock;
    readonly phases: Phase[];
    readonly region: Uint16Array;      // of each mark
    readonly firstSpikes: Float32Array;  // of each mark, s after t0; NaN if it did not fire
    readonly marks: Frames;
    readonly force: Frames;
    readonly perClass: Frames;
    readonly totals: Float64Array;     // spikes of each mark
    readonly siteRegion: Uint16Array;
    private begin: Uint32Array;        // the first afferent of each mark, then the number of afferents
    private copy: Uint32Array;
    private known: Train[] | null = null;
    private bins: SpikeBins | null = null;
    private cached: MarkCounts & {frame: number; frames: number} | null = null;

    constructor(readonly data: SkinPageData) {
        const {over, marks, sites, summary} = data;
        this.clock = {t0: over.t0, T: over.T, samples: over.shown_samples};
        this.phases = summary.input.phases.map(({name, from_s, to_s}) => ({name, from: over.t0 + from_s, to: over.t0 + to_s}));
        [this.begin, this.copy] = [decoded<Uint32Array>(marks.begin), decoded<Uint32Array>(marks.copy)];
        [this.region, this.siteRegion] = [decoded<Uint16Array>(marks.region), decoded<Uint16Array>(sites.region)];
        this.firstSpikes = decoded<Float32Array>(marks.first);
        [this.marks, this.force, this.perClass] = [new Frames(over.marks), new Frames(over.sites), new Frames(over.classes)];
        this.totals = this.marks.totals();
        const active = new Map(summary.rates.filter(({region, phase}) => region === "all" && phase === "all").map((row) => [row.afferent, row.active]));
        const colours = coloursOf(data.classes.map(({name}) => name));
        this.classes = data.classes.map(({name, first, afferents}, k) => ({name, colour: colours[k], afferents, firstAfferent: first, active: active.get(name) || 0,
                                                                          first: firstAt(this.begin, first), end: firstAt(this.begin, first + afferents)}));
        const places = decoded<Float32Array>(sites.places);
        this.geometry = {outline: sites.outline.skin.map((one) => decoded<Float32Array>(one)), borders: sites.outline.regions.map((one) => decoded<Float32Array>(one)),
                         sites: places, side: sites.side || 0.9 * spacing(places), marks: decoded<Float32Array>(marks.places), classes: this.classes};
    }

    get end() { return this.clock.t0 + this.duration; }
    get duration() { return this.clock.samples * this.clock.T; }
    /// The spike trains; null if there are too many spikes for the page.
    get trains(): Train[] | null {
        const {spikes} = this.data.over;
        return spikes && (this.known = this.known || trainsOf(spikes, this.clock.t0));
    }

    /// Calls call(mark, t) for the spikes from `from` to `to`. Only if there are trains.
    spikesBetween(from: number, to: number, call: (mark: number, t: number) => void) {
        this.bins = this.bins || new SpikeBins(this.trains || [], (afferent) => this.markOf(afferent), this.clock.t0, this.duration / 4096);
        this.bins.between(from, to, call);
    }

    markOf(afferent: number) { return firstAt(this.begin, afferent + 1) - 1; }
    classIndex(mark: number) { return this.classes.findIndex(({end}) => mark < end); }
    classOf(mark: number) { return this.classes[this.classIndex(mark)]; }
    afferentsIn(mark: number) { return this.begin[mark + 1] - this.begin[mark]; }
    /// The name of an afferent, which is that of a mark of one.
    nameOf(afferent: number) {
        const {name, firstAfferent} = this.classes.find((one) => afferent < one.firstAfferent + one.afferents)!;
        return `${name}#${afferent - firstAfferent + 1}`;
    }
    markName(mark: number) {
        const more = this.afferentsIn(mark) - 1;
        return `${this.classOf(mark).name}#${this.copy[mark]}${more ? ` and ${more} neighbours` : ""}, ${this.data.regions[this.region[mark]]}`;
    }

    frameAt(t: number) { return Math.max(0, Math.min(this.marks.count - 1, Math.floor((t - this.clock.t0) / this.marks.width + 1e-9))); }
    /// The number of frames in about `seconds`, at least 1.
    framesOver(seconds: number) { return Math.max(1, Math.round(seconds / this.marks.width)); }
    /// Duration (s) of the last `frames` frames up to frame `frame`. The first frames have fewer before them; the last frame may be shorter.
    lengthOver(frame: number, frames: number) { return Math.min((frame + 1) * this.marks.width, this.duration) - Math.max(0, frame + 1 - frames) * this.marks.width; }

    /// The spikes of all marks in the last `frames` frames up to frame `frame`, and the marks with spikes.
    recent(frame: number, frames: number): MarkCounts {
        if (this.cached && this.cached.frame === frame && this.cached.frames === frames) return this.cached;
        const counts = new Uint32Array(this.marks.places), active: number[] = [];
        for (let f = Math.max(0, frame + 1 - frames); f <= frame; ++f)
            this.marks.each(f, (mark, n) => {
                if (!counts[mark]) active.push(mark);
                counts[mark] += n;
            });
        return (this.cached = {frame, frames, counts, active});
    }

    /// For each class, the maximum over marks and time of the rate per afferent (Hz) in a window of `frames` frames; 1 if none fired.
    maxRates(frames: number): number[] {
        const counts = new Int32Array(this.marks.places), rates = this.classes.map(() => 0);
        for (let f = 0; f < this.marks.count; ++f) {
            if (f >= frames) this.marks.each(f - frames, (mark, n) => { counts[mark] -= n; });
            let c = 0;  // marks are ascending in a frame, and those of a class are adjacent
            this.marks.each(f, (mark, n) => {
                counts[mark] += n;
                while (mark >= this.classes[c].end) ++c;
                rates[c] = Math.max(rates[c], counts[mark] / this.afferentsIn(mark) / this.lengthOver(f, frames));
            });
        }
        return rates.map((rate) => rate || 1);
    }

    /// The same over the complete recording.
    meanRates(): number[] {
        return this.classes.map(({first, end}) => {
            let most = 0;
            for (let mark = first; mark < end; ++mark) most = Math.max(most, this.totals[mark] / this.afferentsIn(mark) / this.duration);
            return most || 1;
        });
    }
}

/// The colours of classes: those of all pages if each is of another class of afferents, else the first ones.
function coloursOf(names: string[]): string[] {
    const known = names.map((name) => (/^[sf]a[12](?![a-z0-9])/.exec(name) || [""])[0]), isDistinct = !known.includes("") && new Set(known).size === names.length;
    return names.map((_, k) => (isDistinct ? classColour(known[k]) : seriesColour(k)));
}
