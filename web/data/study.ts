// The data of the pages of studies and of a fitted transistor (reproduction/page/study_page.cpp, src/report/transistor/transistor_page.cpp).

import type {Numbers} from "../base/arrays";
import type {PageData} from "./document";

export interface PlotSeries { name: string; style: "line" | "points" | "path" | "raster"; x: Numbers; y: Numbers; colour?: number }
export interface PlotData { title: string; published?: string; x: string; y: string; log_x: boolean; log_y: boolean; series: PlotSeries[] }

export type Verdict = "" | "agrees" | "differs" | "holds" | "does not hold";

/// One computed number or statement. `texts`: computed, published, deviation and allowed range as text. `deviation` is relative to the published
/// value, and `tolerance` is the largest one that is allowed.
export interface ClaimData {
    label: string; computed: number | boolean | null; unit: string; published: number | null; derived: boolean; deviation: number | null;
    low: number | null; high: number | null; tolerance: number | null; kind: string | null; verdict: Verdict; source: string; note: string;
    texts: [string, string, string, string];
}

export interface StudyRecord { name: string; title: string; question: string; claims: ClaimData[]; plots: PlotData[]; notes: string[] }

interface Count { agreeing: number; deviating: number }
export interface KindData { kind: string; meaning: string; printed: Count; derived: Count; statements: Count }

export interface StudyData extends PageData { headline: string; kinds: KindData[]; studies: StudyRecord[] }

export interface TransistorData extends PageData {
    fit: {parameters: {name: string; card: string; text: string; interval: string; value: number; unit: string; low: number | null; high: number | null; not_determined?: string}[]; notes: string[]};
    plots: PlotData[];
    misfit: string;
}
