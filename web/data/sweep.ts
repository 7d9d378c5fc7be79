// The data of the page of a sweep (src/report/sweep, and document_of() in src/sweep/stats). A "row" is a row of the sweep's table: one finished item.

import type {EncodedArray, Numbers} from "../base/arrays";
import type {Estimate} from "../panels/bars";
import type {PageData} from "./document";

/// is_listed: the axis has a list of values; others are drawn at random.
export interface SweepAxis { name: string; unit: string; description: string; words?: string[]; is_listed: boolean }
/// Limits are there if any measure of the sweep has some; null stands for no limit.
export interface SweepMeasure { name: string; unit: string; description: string; at_least?: number | null; at_most?: number | null }

export interface MeasureSummary {
    name: string; items: number; missing: number; yield?: Estimate; mean: Estimate; sigma: Estimate; min: number | null; max: number | null; quantiles: Estimate[];
    normal_plot: {correlation: number | null; min_of_normal_samples: number | null};
}
export interface PointSummary { point: string; items: number; done: number; truncated: number; diverged: number; passed: number; yield: Estimate; measures: MeasureSummary[] }

interface Device { device: string; fraction: number; fraction_V_T: number; fraction_I_S: number; relative_sigma_at_4x_area: number }
export interface Dependence {
    measure: string; between_points: {axis: string; fraction: number}[]; explained_fraction: number; devices: Device[];
    influences: {axis?: string; device?: string; quantity?: string; fraction: Estimate & {value: number}}[];
}

export interface SweepSummary {
    items: number; finished: number; axes: SweepAxis[]; measures: SweepMeasure[]; quantiles: number[]; all: PointSummary; points: PointSummary[]; depends_on: Dependence[];
}

/// The effect of an axis on a measure: the means at its values over all other axes. `fraction`: of the variance over the grid.
export interface Effect { axis: number; fraction: number; values: Numbers; means: Numbers }
/// Means at each pair of values of two axes, [index in xs][index in ys], for grids whose rows are too many for the page.
export interface Pair { x: number; y: number; xs: Numbers; ys: Numbers; means: Numbers[] }

/// The quantity on the x axis of a scatter plot: an axis, or the mismatch of V_T or I_S of a device.
export interface Factor { name: string; quantity: string; fraction: number; unit: string; axis?: number; values?: Numbers }

export interface HistogramData { from: number; width: number; counts: number[][]; below: number; above: number }
export interface NormalPlotData { scores: Numbers; values: Numbers; correlation: number | null }
export interface EnvelopeData {
    name: string; unit?: string; times: Numbers; every: boolean; items: number; min: Numbers; low: Numbers; median: Numbers; high: Numbers; max: Numbers; medians: Numbers[][];
}
export interface SweepRasterData { name: string; rows: number[]; counts: number[]; times: EncodedArray }

export interface SweepData extends PageData {
    summary: SweepSummary;
    groupings: {name: string; groups: string[]}[];
    single_chip_hint?: string;
    grids?: {effects: Effect[]; pairs: Pair[]}[];      ///< for each measure of a grid
    histograms: (HistogramData | null)[][];           ///< [measure][grouping]
    normal_plots: NormalPlotData[][][];               ///< [measure][grouping][group]
    extremes: number[][];                             ///< rows with the smallest values of each measure, then those with the largest
    factors: Factor[][];
    rasters: SweepRasterData[];
    traces: EnvelopeData[];
    reasons: Record<string, string>;                  ///< why an item diverged
    sizes: Record<string, string>;                    ///< of devices
    points: number[];                                 ///< rows of the scatter plots
    failed: number[];
    /// The values of the rows that the page uses; each array has an element for each of `row`. end: 0 completed, 1 truncated, 2 diverged.
    rows: {row: number[]; item: number[]; end: number[]; passes: number[]; axes: Numbers[]; measures: Numbers[]; groups: number[][]};
}
