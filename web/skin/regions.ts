// The parts of a skin to which the maps can be zoomed.

import {Box, boxOf, emptyBox, grown, joined} from "./geometry";
import type {SkinRecording} from "./recording";

/// The complete skin, whose box is `all`, the touched area, and the regions of the population: names and boxes.
export function regionsOf(skin: SkinRecording, all: Box): [string, Box][] {
    const {geometry, force, siteRegion, data} = skin, touched = new Uint8Array(geometry.sites.length / 2);
    force.place.forEach((p) => touched.fill(1, p * data.over.sites_per_mark, (p + 1) * data.over.sites_per_mark));
    const grow = (box: Box): Box => grown(joined(box, emptyBox()), Math.max(2 * geometry.side, 0.15 * Math.max(box[2] - box[0], box[3] - box[1])));
    const regions: [string, Box][] = [["complete skin", all]];
    if (touched.includes(1) && touched.includes(0)) regions.push(["touched area", grow(boxOf(geometry.sites, (s) => touched[s] > 0))]);
    if (data.regions.length > 1) data.regions.forEach((name, r) => regions.push([name, grow(boxOf(geometry.sites, (s) => siteRegion[s] === r))]));
    return regions.filter(([, box]) => box.every(Number.isFinite));
}
