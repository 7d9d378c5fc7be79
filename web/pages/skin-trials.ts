// Trials of a skin, aligned: the total force of each, and for each class the mean rate of its afferents (population PSTH), by label.

import {TrialFigures, trialsTitle} from "../panels/trial-figures";
import {section} from "../shell";
import type {SkinRecording} from "../skin/recording";

/// The first groups are the classes on the complete skin, the others those in each region where an afferent fired.
export function showTrials(host: Element, skin: SkinRecording): TrialFigures | null {
    const {trials} = skin.data;
    if (!trials) return null;
    const count = trials.classes!, all = trials.groups.map((_, g) => g), regions = [...new Set(trials.groups.slice(count).map(({channel}) => channel))];
    const groupsOf = (choice: number) => (choice ? all.slice(count).filter((g) => trials.groups[g].channel === regions[choice - 1]) : all.slice(0, count));
    return new TrialFigures(section(host, "trials", "Trials", trialsTitle(trials)), trials, {choices: regions.length > 1 ? ["all", ...regions] : ["all"], groupsOf, noun: "Region", firstColour: count});
}
