// The rows of a sweep on its page, and means of measures over axes.

import {numbersOf} from "../base/arrays";
import {seriesColour} from "../base/colours";
import type {Effect, SweepData, SweepMeasure} from "../data/sweep";
import {Axis, textOn} from "../panels/axis";

export class Sweep {
    readonly axisValues: ArrayLike<number>[];     // [axis][index of a row in data.rows]
    readonly measureValues: ArrayLike<number>[];  // [measure][index of a row in data.rows]
    private index: Map<number, number>;           // row -> index in data.rows

    constructor(readonly data: SweepData) {
        [this.axisValues, this.measureValues] = [data.rows.axes.map(numbersOf), data.rows.measures.map(numbersOf)];
        this.index = new Map(data.rows.row.map((row, k) => [row, k]));
    }

    get summary() { return this.data.summary; }
    get measures() { return this.data.summary.measures; }
    get isGrid() { return this.data.grids !== undefined; }
    /// True for a grid with several random items at each point.
    get isMixed() { return !this.isGrid && this.summary.axes.some((one, axis) => one.is_listed && this.levels(axis).length > 1); }
    /// True if the page has every finished item.
    get isComplete() { return this.data.rows.row.length === this.summary.finished; }

    at(row: number) { return this.index.get(row)!; }
    measured(measure: number, row: number): number { return this.measureValues[measure] ? this.measureValues[measure][this.at(row)] : row; }

    axis(k: number): Axis {
        const {name, unit, words} = this.summary.axes[k], levels = this.levels(k);
        return {name, unit, words, isLog: !words && isGeometric(levels)};
    }

    measureAxis(k: number): Axis { return axisOfMeasure(this.measures[k]); }
    levelText(axis: number, value: number) { return textOn(this.summary.axes[axis], value); }

    /// The values of an axis, ascending: those of a grid, else those in the rows of the page.
    levels(axis: number): number[] {
        const effect = this.data.grids?.flatMap(({effects}) => effects).find((one) => one.axis === axis);
        const values = Array.from(effect ? numbersOf(effect.values) : this.axisValues[axis]);
        return [...new Set(values.filter((v) => !Number.isNaN(v)))].sort((a, b) => a - b);
    }

    /// The values of all axes in a row: "press.F_max 2 N, sa1.f_B 20 Hz".
    pointText(row: number) { return this.summary.axes.map(({name}, a) => `${name} ${this.levelText(a, this.axisValues[a][this.at(row)])}`).join(", "); }

    groupColour = (group: number) => seriesColour(group);

    /// Means of a measure at each pair of values of two axes. `fixed`: for each axis the value that the items must have, or null.
    meansOver(measure: number, x: number, y: number, fixed: (number | null)[]): {xs: number[]; ys: number[]; means: (number | null)[][]} {
        if (!this.isComplete) return this.knownMeans(measure, x, y);
        const xs = this.levels(x), ys = this.levels(y), sums = xs.map(() => ys.map(() => [0, 0]));
        const [placeX, placeY] = [xs, ys].map((levels) => new Map(levels.map((value, k) => [value, k])));
        for (let k = 0; k < this.data.rows.row.length; ++k) {
            const value = this.measureValues[measure][k];
            if (Number.isNaN(value) || fixed.some((level, a) => level !== null && a !== x && a !== y && this.axisValues[a][k] !== level)) continue;
            const cell = sums[placeX.get(this.axisValues[x][k])!]?.[placeY.get(this.axisValues[y][k])!];
            if (cell) [cell[0], cell[1]] = [cell[0] + value, cell[1] + 1];
        }
        return {xs, ys, means: sums.map((column) => column.map(([sum, count]) => (count ? sum / count : null)))};
    }

    /// The effects of the listed axes of a grid with random items: the means of the items at each value. The largest effect comes first.
    effectsOfGrid(measure: number): Effect[] {
        const items = Array.from(this.measureValues[measure]), known = items.filter((v) => !Number.isNaN(v)), mean = known.reduce((sum, v) => sum + v, 0) / known.length;
        const total = known.reduce((sum, v) => sum + (v - mean) ** 2, 0);
        if (!(total > 0)) return [];
        const effects = this.summary.axes.map((one, axis) => ({one, axis})).filter(({one, axis}) => one.is_listed && this.levels(axis).length > 1).map(({axis}): Effect => {
            const levels = this.levels(axis), groups = levels.map((level) => items.filter((v, k) => !Number.isNaN(v) && this.axisValues[axis][k] === level));
            const means = groups.map((group) => (group.length ? group.reduce((sum, v) => sum + v, 0) / group.length : null));
            return {axis, fraction: groups.reduce((sum, group, k) => sum + group.length * ((means[k] ?? mean) - mean) ** 2, 0) / total, values: levels, means};
        });
        return effects.sort((one, other) => other.fraction - one.fraction);
    }

    /// The means that C++ has computed over all values of the other axes.
    private knownMeans(measure: number, x: number, y: number) {
        const pair = this.data.grids![measure].pairs.find((one) => (one.x === x && one.y === y) || (one.x === y && one.y === x));
        if (!pair) return {xs: [], ys: [], means: []};
        const [xs, ys, means] = [Array.from(numbersOf(pair.xs)), Array.from(numbersOf(pair.ys)), pair.means.map((column) => Array.from(numbersOf(column), (v) => (Number.isNaN(v) ? null : v)))];
        return pair.x === x ? {xs, ys, means} : {xs: ys, ys: xs, means: ys.map((_, j) => xs.map((__, i) => means[i][j]))};
    }
}

export const axisOfMeasure = ({name, unit}: SweepMeasure): Axis => ({name, unit});

/// True for four or more positive values whose ratios are equal.
function isGeometric(levels: number[]): boolean {
    if (levels.length < 4 || levels[0] <= 0) return false;
    const ratio = (levels[levels.length - 1] / levels[0]) ** (1 / (levels.length - 1));
    return ratio > 1.2 && levels.slice(1).every((value, k) => Math.abs(value / levels[k] / ratio - 1) < 0.02);
}

export const percent = (fraction: number | null) => (fraction === null ? "–" : (100 * fraction).toFixed(1));
export const limitsOf = ({at_least: low, at_most: high}: SweepMeasure) => [low, high].filter((v): v is number => v !== null && v !== undefined);

export function limitsText(measure: SweepMeasure): string {
    const {at_least: low, at_most: high} = measure, text = (value: number) => textOn(measure, value);
    const has = (value: number | null | undefined): value is number => value !== null && value !== undefined;
    return has(low) && has(high) ? `${text(low)} … ${text(high)}` : has(low) ? `min ${text(low)}` : has(high) ? `max ${text(high)}` : "";
}
