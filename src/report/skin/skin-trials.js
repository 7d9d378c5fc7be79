"use strict";
// Trials of a skin, aligned: the total force of each, and for each class the mean rate of its afferents (population PSTH), by label.

class SkinTrialFigure extends TrialFigure {
    /// The complete skin, then each region in which an afferent fired.
    choices() { return ["all", ...this.regions()]; }
    firstChoice() { return 0; }
    /// None if there is only one, which is then the complete skin.
    regions() {
        const names = [...new Set(this.data.groups.slice(this.data.classes).map(({channel}) => channel))];
        return names.length > 1 ? names : [];
    }

    /// The colours of the classes are those of the other figures, so labels have others.
    color(label) { return super.color(this.data.classes + label); }

    /// The indexes of the groups of a choice, one for each class that it has.
    groupsOf(choice) {
        const all = this.data.groups.map((_, g) => g);
        return choice ? all.slice(this.data.classes).filter((g) => this.data.groups[g].channel === this.regions()[choice - 1]) : all.slice(0, this.data.classes);
    }

    panels(width, left, choice) {
        const groups = this.groupsOf(choice);
        return groups.map((group, k) => {
            const {name, afferents} = this.data.groups[group];
            const title = `${name}: mean rate of ${afferents} afferent${afferents === 1 ? "" : "s"} (Hz)`;
            return this.panel(width, left, 100, title, (svg, y) => this.drawHistograms(svg, y, group), this.rateRange(group), k === groups.length - 1);
        });
    }
}
