// Activity of the afferents at a time, as levels from 0 to 1 with a scale: recent spikes, rates in a window, rates of the recording, first spikes.

import {fixedText, quantity} from "../base/text";
import type {SkinRecording} from "./recording";
import type {Levels} from "./surface";

export interface Mode {
    key: string;    ///< for links
    label: string;
    isOverAll: boolean;  ///< it does not change with time
    hasRings: boolean;
    activity: (time: number) => Levels;
    /// Texts along the scale of class k, from level 0 to level 1.
    scale: (k: number) => string[];
}

/// The quantities that the maps can show, the first choice first.
export function modesOf(skin: SkinRecording): Mode[] {
    const classes = skin.classes.map(({name}) => name), windows = skin.trains ? [0.01, 0.05, 0.2].filter((window) => window < skin.duration) : [];
    const frames = [...new Set([0, 0.05, 0.1, 0.2, 0.5].map((seconds) => skin.framesOver(seconds)))].filter((n) => n < skin.marks.count || n === 1);
    const recent = skin.trains ? [recentSpikes(skin, "recent", "Recent spikes", typicalIntervals(skin))] : [];
    const fixed = windows.map((window) => recentSpikes(skin, `spikes-${window}`, `Spikes, ${quantity(window, "s", true)}`, classes.map(() => window)));
    return [...recent, ...fixed, ...frames.map((n) => recentRates(skin, n)), meanRates(skin)];
}

/// For each class, a duration (s) near the median interval between its spikes, so that neighbours with different phases differ: 5 ms to 0.5 s.
function typicalIntervals(skin: SkinRecording): number[] {
    const choices = [0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5];
    return skin.classes.map(({firstAfferent, afferents}) => {
        const intervals: number[] = [];
        for (const {afferent, spikes: {times}} of skin.trains!)
            if (afferent >= firstAfferent && afferent < firstAfferent + afferents) for (let k = 1; k < times.length && k < 50; ++k) intervals.push(times[k] - times[k - 1]);
        const median = intervals.sort((a, b) => a - b)[intervals.length >> 1] || 0.05;
        return choices.find((one) => one >= median) || 0.5;
    });
}

/// Level 1 is a spike at this time, level 0 one `windows[class]` (s) ago.
function recentSpikes(skin: SkinRecording, key: string, label: string, windows: number[]): Mode {
    const levels = new Float32Array(skin.marks.places), longest = Math.max(...windows), windowOf = skin.classes.flatMap(({first, end}, k) => new Array<number>(end - first).fill(windows[k]));
    const activity = (time: number): Levels => (draw) => {
        const marks: number[] = [];
        skin.spikesBetween(time - longest, time, (mark, t) => {
            const level = 1 - (time - t) / windowOf[mark];
            if (level <= 0) return;
            if (!levels[mark]) marks.push(mark);
            levels[mark] = Math.max(levels[mark], level);
        });
        for (const mark of marks) {
            draw(mark, levels[mark]);
            levels[mark] = 0;
        }
    };
    return {key, label, isOverAll: false, hasRings: true, activity, scale: (k) => [`${quantity(windows[k], "s", true)} ago`, "now"]};
}

function recentRates(skin: SkinRecording, frames: number): Mode {
    const most = skin.maxRates(frames), window = frames * skin.marks.width;
    const activity = (time: number): Levels => (draw) => {
        const frame = skin.frameAt(time), {counts, active} = skin.recent(frame, frames), seconds = skin.lengthOver(frame, frames);
        for (const mark of active) draw(mark, counts[mark] / skin.afferentsIn(mark) / seconds / most[skin.classIndex(mark)]);
    };
    return {key: `rate-${+window.toPrecision(6)}`, label: `Rate, ${quantity(window, "s", true)}`, isOverAll: false, hasRings: false, activity, scale: (k) => rateScale(most[k])};
}

function meanRates(skin: SkinRecording): Mode {
    const most = skin.meanRates();
    const activity = (): Levels => (draw) => skin.classes.forEach(({first, end}, k) => {
        for (let mark = first; mark < end; ++mark) if (skin.totals[mark]) draw(mark, skin.totals[mark] / skin.afferentsIn(mark) / skin.duration / most[k]);
    });
    return {key: "mean", label: "Mean rate", isOverAll: true, hasRings: false, activity, scale: (k) => rateScale(most[k])};
}

const rateScale = (most: number) => ["0", quantity(most / 2, "Hz", true), quantity(most, "Hz", true)];

export interface FirstSpikes { activity: Levels; scale: string[] }

/// The first spike of each afferent. The colours are spread evenly over the afferents: each quarter of the scale has as many. Null if none fired.
export function firstSpikesOf(skin: SkinRecording): FirstSpikes | null {
    const times = Float32Array.from(skin.firstSpikes).filter((t) => !Number.isNaN(t)).sort();
    if (!times.length) return null;
    const stops = [...new Set([0, 0.25, 0.5, 0.75, 1].map((fraction) => times[Math.round(fraction * (times.length - 1))]))];
    const level = (t: number) => {
        const k = Math.max(1, stops.findIndex((stop) => stop >= t));
        return stops.length < 2 ? 0 : (k - 1 + (t - stops[k - 1]) / (stops[k] - stops[k - 1])) / (stops.length - 1);
    };
    const activity: Levels = (draw) => skin.firstSpikes.forEach((t, mark) => { if (!Number.isNaN(t)) draw(mark, level(t)); });
    const resolution = Math.max(1e-6, (stops[stops.length - 1] - stops[0]) / 400);
    return {activity, scale: stops.map((t) => fixedText(skin.clock.t0 + t, resolution))};
}
