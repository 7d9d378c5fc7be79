// The data of the pages as C++ writes them (src/report). Keys and meanings are those of the C++ functions named *_document.

import type {EncodedArray} from "../base/arrays";
import type {Cell} from "../base/text";
import type {Phase, SpikesRecord, TraceRecord} from "../panels/signals";

/// The part that all pages have.
export interface PageData { page: string; title: string; program: string; command: string; notes?: string[]; versions?: Record<string, string> }

export interface TableData { columns: string[]; decimals: (number | null)[]; rows: Cell[][] }

export interface ParameterData {
    name: string; value: number; unit: string; default: number; set: boolean; description: string; source: string; component: string;
    spread?: number; spread_factor?: number;
}

export interface ChannelData { id: number; name: string; unit: string }
export interface InputData { name: string; description: string; t0: number; T: number; samples: number; phases: Phase[]; channels: ChannelData[] }

export interface AfferentData {
    name: string; type: string; netlist: boolean; composition: string; description: string; V_th: number | null; V_reset: number | null;
    parameters: ParameterData[]; probes: {name: string; unit: string}[];
}

export interface TrialData { label: string; input: string; zero: number | null; from: number; to: number; force: {from: number; step: number; values: EncodedArray} }
export interface HistogramData { label: string; group: number; edges: number[]; end: number; trials: number[]; rate: (number | null)[]; error: (number | null)[] }
export interface TrialsData {
    onset: boolean; bin: number; trials: TrialData[]; labels: string[]; groups: {name: string; channel: string; afferents: number}[];
    histograms: HistogramData[]; classes?: number; spikes?: {trial: number; group: number; times: EncodedArray}[];
}

export interface QualityData { notes: {text: string; grave: boolean}[]; columns: string[]; rows: Cell[][] }

/// Power and area of a netlist, by block. Powers are in W, areas in m².
export interface CostData {
    afferent: string; rest_force_N: number; area: {total_m2: number}; afferents?: {per_mm2: number};
    power: {op: {delivered_W: number; sensor_W: number; blocks_W: Record<string, number>}; mean?: {delivered_W: number; sensor_W: number}};
    blocks: {block: string; area: {total_m2: number}; worst_leak?: {current_A: number}}[];
}

export interface RespondData extends PageData {
    inputs: InputData[]; afferents: AfferentData[]; traces: TraceRecord[]; spikes: SpikesRecord[]; table: TableData;
    comparisons: TableData & {cost: number; tau: number}; quality: QualityData;
    costs?: CostData[]; trials?: TrialsData; versions: Record<string, string>;
    copies?: {count: number; shown: number; has_probes: boolean; rates: {afferent: string; channel: number; bin: number; values: number[]}[]};
}
