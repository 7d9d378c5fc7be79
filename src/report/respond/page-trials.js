"use strict";
// Trials, aligned: the force of each, the spikes of one afferent, and their histogram (PSTH), by label. Drawn as SVG in the width of the page.
// Derived classes define choices() of the selector and panels() for the selected one.

const MAX_TRIAL_LABELS = 8;  // more labels share colours, as the afferents do

class TrialFigure {
    constructor(section, data) {
        Object.assign(this, {section, data, select: section.querySelector("select"), host: section.querySelector(".trial-plots")});
        this.order = data.trials.map((_, t) => t).sort((a, b) => this.label(a) - this.label(b) || a - b);
        const choices = this.choices();
        this.select.innerHTML = choices.map((text, k) => `<option value="${k}">${escaped(text)}</option>`).join("");
        this.select.value = this.firstChoice();
        this.select.onchange = () => this.draw();
        section.querySelector("label").hidden = choices.length < 2;
        const ends = data.trials.filter(({zero}) => zero !== null);
        this.from = Math.min(...ends.map(({from}) => from));
        this.to = Math.max(...ends.map(({to}) => to));
        section.querySelector(".trial-labels").innerHTML = data.labels.map((label, k) =>
            `<span class="legend-item"><span class="chip" style="background: ${this.color(k)}"></span>${escaped(label)} (${data.trials.filter((one) => one.label === label).length})</span>`).join("");
        if (ends.length) new ResizeObserver(() => this.draw()).observe(this.host);
    }

    label(trial) { return this.data.labels.indexOf(this.data.trials[trial].label); }
    color(label) { return `var(--series-${label % MAX_TRIAL_LABELS})`; }

    choices() { return this.data.groups.map(({name, channel}) => `${name} ${channel}`); }

    /// The most active group.
    firstChoice() {
        const counts = this.data.groups.map(() => 0);
        for (const {group, times} of this.data.spikes) counts[group] += times.length;
        return counts.indexOf(Math.max(...counts));
    }

    draw() {
        const width = this.host.clientWidth;
        if (width < 60) return;
        const left = isNarrow() ? 40 : 64;
        this.x = (t) => left + (t - this.from) / (this.to - this.from) * (width - left - 14);
        this.host.replaceChildren(this.panel(width, left, 110, "force (N)", (svg, y) => this.drawForces(svg, y), this.forceRange()),
                                  ...this.panels(width, left, Number(this.select.value)));
    }

    /// The raster and the histogram of a group.
    panels(width, left, group) {
        const rows = Math.max(60, Math.min(420, this.order.length * 11));
        return [this.panel(width, left, rows, "trials", (svg) => this.drawRaster(svg, rows, group), null),
                this.panel(width, left, 150, "rate (Hz)", (svg, y) => this.drawHistograms(svg, y, group), this.rateRange(group), true)];
    }

    /// A plot with a title and axes. `range`: [low, high] of the vertical axis, or null without one. `last`: labels the time axis.
    panel(width, left, height, title, drawContent, range, last = false) {
        const top = 18, svg = shape(null, "svg", {width, height: top + height + (last ? 20 : 4), role: "img", "aria-label": title});
        const y = range && ((v) => top + height - (v - range[0]) / (range[1] - range[0]) * height);
        shape(svg, "text", {x: left, y: 12, class: "trial-title"}).textContent = title;
        if (range) {
            const {values, decimals} = roundTicks(range[0], range[1], height / 32);
            for (const v of values) {
                shape(svg, "line", {x1: left, x2: width - 14, y1: y(v), y2: y(v), stroke: "var(--grid)"});
                shape(svg, "text", {x: left - 6, y: y(v) + 4, "text-anchor": "end"}).textContent = v.toFixed(decimals).replace("-", "−");
            }
        }
        drawContent(svg, y);
        shape(svg, "line", {x1: this.x(0), x2: this.x(0), y1: top, y2: top + height, stroke: "var(--level)", "stroke-dasharray": "4 3"});
        shape(svg, "line", {x1: left, x2: width - 14, y1: top + height, y2: top + height, stroke: "var(--axis)"});
        if (last) this.drawTimes(svg, width, top + height);
        return svg;
    }

    drawTimes(svg, width, y) {
        const {values, decimals} = roundTicks(this.from, this.to, width / 110);
        for (const t of values) {
            const edge = this.x(t) > width - 30;
            shape(svg, "text", {x: edge ? width - 2 : this.x(t), y: y + 15, "text-anchor": edge ? "end" : "middle"}).textContent = `${t.toFixed(decimals).replace("-", "−")} s`;
        }
    }

    forces() {
        this.decoded = this.decoded || this.data.trials.map(({force}) => (force.values ? new Float32Array(bytesOf(force.values).buffer) : []));
        return this.decoded;
    }

    forceRange() {
        const all = this.forces().map((values) => values.reduce(([low, high], v) => [Math.min(low, v), Math.max(high, v)], [0, 0]));
        const low = Math.min(...all.map((one) => one[0])), high = Math.max(...all.map((one) => one[1]), low + 1e-6);
        return [low - 0.03 * (high - low), high + 0.05 * (high - low)];
    }

    drawForces(svg, y) {
        this.order.forEach((trial) => {
            const {force} = this.data.trials[trial], values = this.forces()[trial];
            if (!values.length) return;
            const points = Array.from(values, (v, k) => `${this.x(force.from + (k + 0.5) * force.step).toFixed(1)},${y(v).toFixed(1)}`).join(" ");
            shape(svg, "polyline", {points, fill: "none", stroke: this.color(this.label(trial)), "stroke-width": 1.2, "stroke-opacity": this.order.length > 6 ? 0.55 : 0.9});
        });
    }

    drawRaster(svg, height, group) {
        const row = height / this.order.length, lines = this.data.labels.map(() => []);
        const rowOf = new Map(this.order.map((trial, k) => [trial, k]));
        for (const spikes of this.data.spikes) {
            if (spikes.group !== group) continue;
            const top = 18 + rowOf.get(spikes.trial) * row, mark = Math.max(1, row - 2);
            for (const t of new Float64Array(bytesOf(spikes.times).buffer)) lines[this.label(spikes.trial)].push(`M${this.x(t).toFixed(1)} ${(top + 1).toFixed(1)}v${mark.toFixed(1)}`);
        }
        lines.forEach((path, label) => { if (path.length) shape(svg, "path", {d: path.join(""), stroke: this.color(label), "stroke-width": 1.3}); });
        this.order.forEach((trial, k) => {
            const {zero} = this.data.trials[trial], y = 18 + k * row;
            if (zero === null) shape(svg, "text", {x: this.x(this.from) + 4, y: y + row / 2 + 4}).textContent = "no contact";
            if (k && this.label(trial) !== this.label(this.order[k - 1])) shape(svg, "line", {x1: this.x(this.from), x2: this.x(this.to), y1: y, y2: y, stroke: "var(--rule)"});
        });
    }

    histograms(group) { return this.data.histograms.filter((one) => one.group === group); }

    rateRange(group) {
        const high = Math.max(...this.histograms(group).flatMap(({rate, error}) => rate.map((v, k) => (v || 0) + (error[k] || 0))), 1);
        return [0, 1.06 * high];
    }

    drawHistograms(svg, y, group) {
        for (const {label, edges, end, rate, error} of this.histograms(group)) {
            const color = this.color(this.data.labels.indexOf(label)), x = (k) => this.x(k < edges.length ? edges[k] : end).toFixed(1);
            const steps = (value) => rate.map((v, k) => (v === null ? "" : `${rate[k - 1] === undefined || rate[k - 1] === null ? "M" : "L"}${x(k)} ${y(value(v, k)).toFixed(1)}H${x(k + 1)}`)).join("");
            rate.forEach((v, k) => {
                if (v !== null && error[k]) shape(svg, "rect", {x: x(k), width: Math.max(0, x(k + 1) - x(k)), y: y(v + error[k]), height: y(v - error[k]) - y(v + error[k]), fill: color, "fill-opacity": 0.18});
            });
            shape(svg, "path", {d: steps((v) => v), fill: "none", stroke: color, "stroke-width": 1.6});
        }
    }
}

/// Adds an SVG element.
function shape(parent, tag, attributes) {
    const node = document.createElementNS(document.querySelector("#trials svg").namespaceURI, tag);
    for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
    if (parent) parent.append(node);
    return node;
}

/// Shows the section of trials if the run has them. `Figure`: the class of the figure.
function showTrials(data, Figure = TrialFigure) {
    const section = document.getElementById("trials");
    section.hidden = !data;
    if (!data) return;
    section.querySelector("small").textContent = `${data.trials.length} trials, aligned to ${data.onset ? "contact onset" : "their start"}; mean rate and its standard error over the trials of a label, in bins of ${quantity(data.bin, "s", true)}`;
    new Figure(section, data);
}
