"use strict";
// Raster of the spikes of many items of a sweep, sorted by the selected measure, with the smallest value at the bottom.

const RASTER = {left: 66, right: 8, top: 4, bottom: 34};  // margins, pixels

/// The items sorted by the selected measure, the largest first, each with its spike times (s). `rows`: rows of the sweep; `counts`: their numbers of
/// spikes; `times`: all spike times as base64.
function rasterLanes({rows, counts, times}) {
    const bytes = Uint8Array.from(atob(Object.values(times)[0]), (c) => c.charCodeAt(0)), all = new Float32Array(bytes.buffer), values = measured(state.measure, rows), groups = groupsOf(rows);
    let from = 0;
    const lanes = rows.map((row, k) => ({row, value: values[k], group: groups[k], spikes: all.subarray(from, (from += counts[k]))}));
    return lanes.sort((a, b) => (b.value ?? -Infinity) - (a.value ?? -Infinity) || b.row - a.row);
}

function showRaster(host, train) {
    const lanes = rasterLanes(train), end = lanes.reduce((last, {spikes}) => Math.max(last, ...spikes.slice(-1)), 0) * 1.02 || 1;
    const thinned = train.rows.length < table.finished ? `${train.rows.length} of ${table.finished} items, ` : "";
    const node = element(host, "figure", "raster");
    const caption = element(node, "figcaption", "", `${escaped(train.name)} <span class="unit">${thinned}sorted by ${escaped(measures[state.measure]?.name ?? "item")}, smallest at the bottom; failed items are marked on the left</span>`);
    const readout = element(caption, "span", "readout");
    const canvas = element(node, "canvas");
    canvas.setAttribute("aria-label", `spikes of ${train.rows.length} items`);
    const plotHeight = Math.max(80, Math.min(420, 8 * lanes.length));
    const paint = () => paintRaster(canvas, lanes, end, plotHeight);
    new ResizeObserver(paint).observe(node);
    canvas.addEventListener("mousemove", (event) => {
        const lane = lanes[Math.floor((event.offsetY - RASTER.top) / plotHeight * lanes.length)];
        readout.textContent = lane ? ` item ${data.rows.item[rowNumber.get(lane.row)]}, ${measures[state.measure]?.name ?? ""} ${quantity(lane.value, measures[state.measure]?.unit ?? "", true)}, ${lane.spikes.length} spikes` : "";
    });
}

function paintRaster(canvas, lanes, end, plotHeight) {
    const fullWidth = canvas.parentElement.clientWidth, scale = devicePixelRatio || 1, context = canvas.getContext("2d");
    [canvas.width, canvas.height] = [fullWidth * scale, (plotHeight + RASTER.top + RASTER.bottom) * scale];
    canvas.style.height = `${plotHeight + RASTER.top + RASTER.bottom}px`;
    context.scale(scale, scale);
    const width = fullWidth - RASTER.left - RASTER.right, lane = plotHeight / lanes.length, x = (t) => RASTER.left + t / end * width;
    paintAxis(context, x, end, plotHeight, width);
    lanes.forEach(({row, group, spikes}, k) => {
        const y = RASTER.top + k * lane;  // lane: height of a lane, pixels
        context.fillStyle = groupColour(group);
        for (const t of spikes) context.fillRect(x(t) - 0.6, y, 1.2, Math.max(lane * 0.9, 0.6));
        if (data.rows.passes[rowNumber.get(row)]) return;
        context.fillStyle = colour(1);
        context.fillRect(RASTER.left - 8, y, 5, Math.max(lane, 0.6));
    });
}

function paintAxis(context, x, end, plotHeight, width) {
    const bottom = RASTER.top + plotHeight;
    context.font = "11px system-ui, sans-serif", context.textAlign = "center", context.fillStyle = themeColour("faint"), context.strokeStyle = themeColour("grid");
    for (const t of roundTicks(0, end, width / 90).values) {
        context.beginPath(), context.moveTo(x(t), RASTER.top), context.lineTo(x(t), bottom + 4), context.stroke();
        context.fillText(quantity(t, "s", true), x(t), bottom + 16);
    }
    context.strokeStyle = themeColour("axis");
    context.beginPath(), context.moveTo(x(0), bottom), context.lineTo(x(end), bottom), context.stroke();
    context.fillText("time", x(end / 2), bottom + 30);
}
