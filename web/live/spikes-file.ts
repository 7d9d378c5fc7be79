// The spikes of a replay as a file, as `corpuscle respond --out` writes it.

import type {LiveTrain} from "./history";

/// A text as a field of CSV, quoted as the program does it (src/core/text/csv_field.cpp).
const field = (text: string) => (/[",;\t\r\n]|^[ #%]| $/.test(text) ? `"${text.replace(/"/g, '""')}"` : text);

/// Names for rows, of which several may be of the same afferent: "sa1", "sa1#2".
function distinct(names: string[]): string[] {
    return names.map((name, k) => {
        const number = names.slice(0, k + 1).filter((one) => one === name).length;
        return number > 1 ? `${name}#${number}` : name;
    });
}

/// spikes.csv: all spikes in order of time, to the nanosecond.
export function spikesText(names: string[], channel: string, trains: LiveTrain[]): string {
    const fields = distinct(names).map((name) => `${field(name)},${field(channel)}`);
    const spikes = trains.flatMap(({times}, row) => times.map((t) => ({t, row}))).sort((a, b) => a.t - b.t || a.row - b.row);
    return "afferent,channel,time_s\n" + spikes.map(({t, row}) => `${fields[row]},${t.toFixed(9)}\n`).join("");
}
