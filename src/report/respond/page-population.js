"use strict";
// Firing rates in equal bins, each the mean over all copies of an afferent or over the afferents of a class.

const DASHES = [null, [6, 3], [2, 2], [8, 2, 2, 2]];

/// A step curve for each afferent.
class PopulationPanel extends Panel {
    /// `rates`: [{name, color, index, bin, values}], with the bin in s and values in Hz; `index` selects the dashes. All bins are equal. `noun`:
    /// "copy" or "afferent", of which the rate is the mean, for the title.
    constructor({rates, noun = "copy", ...rest}) {
        const highest = rates.reduce((high, {values}) => values.reduce((m, v) => Math.max(m, v), high), 0);
        const power = Math.max(0, prefixPower(highest, "Hz"));  // rates below 1 Hz are not shown in mHz
        super({...rest, scale: 10 ** power, title: "", bottom: true,
               series: rates.map(({name, color, index}) => ({label: name, html: escaped(name), color, width: 1.6, dash: DASHES[index % DASHES.length]}))});
        Object.assign(this, {rates, highest, noun, unit: PREFIXES[power] + "Hz"});
        this.heading.querySelector(".panel-title").innerHTML = this.titleOf();
    }

    titleOf() { return titleHtml(`mean rate per ${this.noun}, in bins of ${quantity(this.rates[0].bin, "s", true)}`, this.unit); }

    /// The start (s) of bin k, which is the end of bin k - 1. The last bin ends with the recording.
    edge(k) { return Math.min(this.input.t0 + k * this.rates[0].bin, endOf(this.input)); }
    binAt(t) { return Math.floor((t - this.input.t0) / this.rates[0].bin); }

    rows(a, b) {
        const last = this.rates[0].values.length - 1, rows = [];
        for (let k = Math.max(0, this.binAt(a)); k <= Math.min(last, this.binAt(b)); ++k)
            for (const t of [this.edge(k), this.edge(k + 1)]) rows.push([t, ...this.rates.map(({values}) => values[k])]);
        return rows;
    }

    range(rows) {
        const high = rows && rows.length ? this.rates.reduce((m, _, k) => Math.max(m, maximum(rows, k + 1)), 0) : this.highest;
        return [(high || 1) * -0.04, (high || 1) * 1.08];
    }

    showValues(t) {
        const k = this.binAt(t);
        this.rates.forEach(({values}, s) => { this.values[s].textContent = !(k in values) ? "–" : values[k] < 1 ? `${Number(values[k].toPrecision(3))} Hz` : quantity(values[k], "Hz"); });
    }
}
