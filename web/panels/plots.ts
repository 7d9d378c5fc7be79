// Plots of studies and fits as panels, and as small pictures.

import {numbersOf} from "../base/arrays";
import {onAppearanceChange, resolved} from "../base/colours";
import {h} from "../base/dom";
import {label} from "../base/label";
import type {PlotData} from "../data/study";
import {axisOf, positionOn} from "./axis";
import {Curve, extentsOf, paintCurve, seriesStyle} from "./curves";
import {XyPanel} from "./xy-panel";

/// The curves of a plot. A series without a name has the colour of the points that it fits.
export const curvesOf = ({series}: PlotData): Curve[] => series.map(({name, style, x, y, colour}, k) => {
    const isAlone = name === "" && colour === undefined, shown = isAlone ? "computed" : name;
    const isRepeated = shown !== "" && series.findIndex((one) => one.name === name) !== k;  // the legend needs unique names
    return {name: isRepeated ? `${shown} (${k + 1})` : shown, label: label(isRepeated ? `${shown} (${k + 1})` : shown), style, x: numbersOf(x), y: numbersOf(y), ...seriesStyle(colour ?? k, style)};
});

/// A plot as a panel with its published shape below the heading. `prefix`: makes its name unique on the page.
export function plotPanel(host: Element, plot: PlotData, prefix = ""): XyPanel {
    const curves = curvesOf(plot), isRaster = curves.every(({style}) => style === "raster");
    const panel = new XyPanel({host, name: prefix + plot.title, title: plot.title, about: `${plot.title}: ${curves.map(({name}) => name).filter(Boolean).join(", ")}`,
                               height: isRaster ? Math.max(70, 24 * curves.length) : 220, xAxis: axisOf(plot.x, plot.log_x), yAxis: axisOf(plot.y, plot.log_y), curves});
    if (plot.published) panel.root.append(h("p", {class: "note published"}, "Published: ", ...label(plot.published)));
    return panel;
}

/// A small picture of a plot, without axes.
export function thumbnail(plot: PlotData): HTMLCanvasElement {
    const canvas = h("canvas", {class: "thumbnail", "aria-hidden": "true"});
    const all = curvesOf(plot), x = axisOf(plot.x, plot.log_x), y = axisOf(plot.y, plot.log_y), isRaster = all.every(({style}) => style === "raster");
    const curves: Curve[] = all.map((curve, k) => ({...curve, width: 1.3, x: Float64Array.from(curve.x, (v) => positionOn(x, v)),
                                                   y: isRaster ? new Float64Array(curve.x.length).fill(all.length - k) : Float64Array.from(curve.y, (v) => positionOn(y, v))}));
    const draw = () => paintThumbnail(canvas, curves, isRaster);
    new ResizeObserver(draw).observe(canvas);
    onAppearanceChange(draw);
    return canvas;
}

function paintThumbnail(canvas: HTMLCanvasElement, curves: Curve[], isRaster: boolean) {
    const ratio = devicePixelRatio || 1, w = canvas.clientWidth, height = canvas.clientHeight, pen = canvas.getContext("2d")!;
    [canvas.width, canvas.height] = [Math.round(w * ratio), Math.round(height * ratio)];
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    const [[left, right], [low, high]] = extentsOf(curves), rows = curves.length, margin = 6;
    const [bottom, top] = isRaster ? [0.5, rows + 0.5] : [low, high];
    const plane = {x: (v: number) => margin + (v - left) / (right - left || 1) * (w - 2 * margin), y: (v: number) => height - margin - (v - bottom) / (top - bottom || 1) * (height - 2 * margin)};
    pen.strokeStyle = resolved("var(--grid)");
    pen.lineWidth = 1;
    pen.strokeRect(0.5, 0.5, w - 1, height - 1);
    pen.lineJoin = "bevel";
    for (const curve of curves) paintCurve(pen, curve, plane, (height - 2 * margin) / rows);
}
