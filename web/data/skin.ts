// The data of the page of a skin, as src/report/skin writes them.

import type {EncodedArray} from "../base/arrays";
import type {TraceRecord} from "../panels/signals";
import type {PageData, ParameterData, TrialsData} from "./document";

/// The values of many places over time (class Frames). `width`: of a frame, s. `max`: the value of level 254, if the values are levels.
export interface FramesRecord { count: number; width: number; places: number; max?: number; data: EncodedArray }
/// The spike times of the afferents that fired (class Trains). `tick`: unit of the packed times, s.
export interface TrainsRecord { count: number; trains: number; tick: number; data: EncodedArray }

/// Spikes of a class in a region or "all", in a phase or "all". Times are since the start.
export interface RateRow {
    afferent: string; region: string; phase: string; afferents: number; touched: number; active: number; spikes: number;
    rate_of_active_Hz: number | null; rate_while_touched_Hz: number | null; max_rate_Hz: number | null; first_spike_s: number | null; median_first_spike_s: number | null;
}

interface Source { quantity: string; source: string }

export interface ClassSummary {
    name: string; afferents: number; source?: string; sources: Source[];
    regions: Record<string, {afferents: number; afferents_per_cm2?: number}>;
    receptive_field: {sigma_m: number; depth_m: number; surround: number; hot_spots: number; hot_spot_spread_m: number};
    conduction: {velocity_m_s: number; standard_deviation_m_s: number};
}

export interface SkinPageData extends PageData {
    summary: {
        input: {description: string; contact: string; touched_from_s: number | null; phases: {name: string; from_s: number; to_s: number}[]};
        skin: {description: string; afferents: number; seed: number; site_area_m2: number; regions: Record<string, {area_cm2: number}>; sources: Source[]};
        classes: ClassSummary[];
        rates: RateRow[];
        first_spikes: {afferent_index: number; afferent: string; region: string; time_s: number}[];
    };
    regions: string[];
    /// Lengths in m. `side` is 0 if the sites have no area.
    sites: {places: EncodedArray; side: number; outline: {skin: EncodedArray[]; regions: EncodedArray[]}; region: EncodedArray; names: string[] | null};
    /// Arrays with one value for each mark: its first afferent, place, region, number of its first afferent within the class (from 1), and
    /// first spike (s after t0; NaN without).
    marks: {begin: EncodedArray; places: EncodedArray; region: EncodedArray; copy: EncodedArray; first: EncodedArray};
    classes: {name: string; composition: string; description: string; source: string; first: number; afferents: number; parameters: ParameterData[]}[];
    over: {
        t0: number; T: number; samples: number; shown_samples: number; force: TraceRecord; afferents_per_mark: number; sites_per_mark: number; max_spikes: number;
        classes: FramesRecord; marks: FramesRecord; sites: FramesRecord; spikes: TrainsRecord | null;
    };
    trials: TrialsData | null;
    versions: Record<string, string>;
}
