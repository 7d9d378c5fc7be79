// The working range of the chips: 0.5 to 0.9 V by -55 to 125 C in five process corners, each under the thesis's press stimulus. It also
// finds the limiting mechanism, and the range with leak mirror and switches of the standard threshold.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <span>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/chip_range.hpp"

namespace corpuscle::studies::range {

constexpr const char *chips[] = {"sa1-circuit", "fa1-circuit"}, *corners[] = {"tt", "ss", "ff", "sf", "fs"};
constexpr double supplies[] = {0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9},           // V
    temperatures[] = {-55, -40, -20, 0, 27, 50, 75, 85, 100, 125};                         // C
constexpr double nominal_supply = 0.7, nominal_temperature = 27;                           // V, C
constexpr double min_supply = 0.6, max_supply = 0.8, min_celsius = -20, max_celsius = 85;  // the range that is counted, V and C

/// The complete grid, and the axes through the nominal point with devices of the standard threshold.
std::vector<ChipCondition> tried_conditions() {
    std::vector<ChipCondition> out;
    for (const char* corner : corners)
        for (const bool high_threshold : {true, false})
            for (const double celsius : temperatures)
                for (const double supply : supplies)
                    if (high_threshold || celsius == nominal_temperature || supply == nominal_supply)
                        out.push_back({corner, supply, celsius, high_threshold});
    return out;
}

/// The cause of a failure: what did not converge, or the ranges that were left.
std::string reason(const ChipRange& range, const ConditionTrial& t) {
    if (!t.response.error.empty()) return t.response.error;
    std::string out;
    for (const auto& warning : t.response.range_warnings) out += (out.empty() ? "" : "; ") + warning;
    auto other = t.response.condition;
    other.high_threshold = true;
    if (out.empty() && !t.response.condition.high_threshold && range.at(other).works)
        return "switches that are off leak as much as the membrane's own leak; it works with the default, hv_membrane=1";
    return out.empty() ? "the chip's currents are too small or too large, but no voltage or current leaves its range" : out;
}

/// "protraction / plateau / retraction / after".
std::string counts_text(const ConditionTrial& t) {
    return fmt::format("{:g} / {:g} / {:g} / {:g}", t.counts[1], t.counts[2], t.counts[3], t.counts[4]);
}

/// One direction of an axis through the nominal point.
struct Direction {
    const char* label;
    std::span<const double> values;
    bool is_supply, is_up;
};
constexpr Direction directions[] = {{"at 27 C down to", supplies, true, false},
                                    {"at 27 C up to", supplies, true, true},
                                    {"at 0.7 V down to", temperatures, false, false},
                                    {"at 0.7 V up to", temperatures, false, true}};

/// Adds a claim: the last value in this direction, from the nominal point on, at which the condition holds without a gap.
void add_limit(const ChipRange& range, ChipCondition from, const Direction& d, const std::string& label, bool ConditionTrial::* holds,
               StudyResult& out) {
    auto& moving = d.is_supply ? from.supply : from.celsius;
    auto values = std::vector(d.values.begin(), d.values.end());
    if (!d.is_up) std::reverse(values.begin(), values.end());
    const auto nominal = std::find(values.begin(), values.end(), moving);
    double last = Claim::none;
    std::string beyond = "in the whole range tried";
    for (auto at = nominal; at != values.end(); ++at) {
        moving = *at;
        const auto& trial = range.at(from);
        if (!(trial.*holds)) {
            beyond = fmt::format("{} {}: {}; {}", *at, d.is_supply ? "V" : "C", counts_text(trial), reason(range, trial));
            break;
        }
        last = *at;
    }
    if (!std::isnan(last)) out.claim(label + " " + d.label, last, d.is_supply ? "V" : "C").explain(beyond);
}

/// The number of conditions of the counted range in a corner for which `holds`, and their total number.
std::pair<int, int> count(const ChipRange& range, const char* corner, bool ConditionTrial::* holds) {
    std::pair<int, int> out{0, 0};
    for (const auto& t : range.trials) {
        const auto& c = t.response.condition;
        const bool counted = c.high_threshold && c.corner == corner && c.supply >= min_supply && c.supply <= max_supply &&
                             c.celsius >= min_celsius && c.celsius <= max_celsius;
        out.second += counted, out.first += counted && t.*holds;
    }
    return out;
}

void report(const ChipRange& range, const char* corner, StudyResult& out) {
    const auto name = fmt::format("{}, {}", range.chip, corner);
    const ChipCondition nominal{corner, nominal_supply, nominal_temperature, true};
    const auto& at_nominal = range.at(nominal);
    out.claim(name + ": spikes under the press stimulus at 0.7 V, 27 C", static_cast<double>(at_nominal.response.spikes.size()))
        .explain(counts_text(at_nominal));
    for (const auto& d : directions) add_limit(range, nominal, d, name + ": works", &ConditionTrial::works, out);
    for (const auto& d : directions) add_limit(range, nominal, d, name + ": within the limits", &ConditionTrial::within_limits, out);
    for (const auto& [label, holds] :
         {std::pair("works", &ConditionTrial::works), std::pair("within the limits", &ConditionTrial::within_limits)}) {
        const auto [good, all] = count(range, corner, holds);
        out.claim(fmt::format("{}: {} at this many of {} conditions from 0.6 to 0.8 V and -20 to 85 C", name, label, all), good);
    }
    auto standard = nominal;
    standard.high_threshold = false;
    const auto& at_standard = range.at(standard);
    const auto label = name + " with hv_membrane=0: works";
    if (at_standard.works) {
        for (const auto& d : directions) add_limit(range, standard, d, label, &ConditionTrial::works, out);
    } else {
        out.claim(name + " with hv_membrane=0: spikes at 0.7 V, 27 C", static_cast<double>(at_standard.response.spikes.size()))
            .explain(fmt::format("does not work; {}: {}", counts_text(at_standard), reason(range, at_standard)));
    }
}

/// The picture of a corner: a point for each condition, in three classes.
void add_map(const ChipRange& range, const char* corner, StudyResult& out) {
    StudyCurve within, works, fails;
    for (const auto& t : range.trials) {
        const auto& c = t.response.condition;
        if (!c.high_threshold || c.corner != corner) continue;
        auto& points = t.within_limits ? within : t.works ? works : fails;
        points.x.push_back(c.celsius), points.y.push_back(c.supply);
    }
    auto& plot = out.plot(fmt::format("{}, {}: supply by temperature", range.chip, corner), "temperature (C)", "supply (V)");
    plot.points("does not work", fails);
    plot.points("works", works);
    plot.points("spikes within the limits", within);
}

/// Plots the spikes of the typical corner over one axis; the other quantity is nominal.
void add_rasters(const ChipRange& range, const char* title, const char* label, double ChipCondition::* axis, double ChipCondition::* other,
                 double nominal, StudyResult& out) {
    StudyCurve high, standard;
    for (const auto& t : range.trials) {
        const auto& c = t.response.condition;
        if (c.*other != nominal || c.corner != "tt") continue;
        auto& line = c.high_threshold ? high : standard;
        for (const double at : t.response.spikes) line.x.push_back(at), line.y.push_back(c.*axis);
    }
    auto& plot = out.plot(fmt::format("{}, tt: the press stimulus at several {}", range.chip, title), "time (s)", label);
    plot.points("default", high), plot.points("hv_membrane=0", standard);
}

void add_plots(const ChipRange& range, StudyResult& out) {
    for (const char* corner : corners) add_map(range, corner, out);
    add_rasters(range, "supplies", "supply (V)", &ChipCondition::supply, &ChipCondition::celsius, nominal_temperature, out);
    add_rasters(range, "temperatures", "temperature (C)", &ChipCondition::celsius, &ChipCondition::supply, nominal_supply, out);
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    std::vector<ChipRange> all;
    const auto tried = tried_conditions();
    for (const char* chip : chips) {
        const double done = static_cast<double>(all.size());
        all.push_back(TRY(explore_range(
            chip, tried, [&](double part) { return options.should_continue((done + part) / static_cast<double>(std::size(chips))); })));
    }
    std::size_t runs = 0, failed_runs = 0;
    for (const auto& range : all) {
        for (const char* corner : corners) report(range, corner, out);
        add_plots(range, out);
        runs += range.trials.size();
        failed_runs += static_cast<std::size_t>(
            std::count_if(range.trials.begin(), range.trials.end(), [](const ConditionTrial& t) { return !t.response.error.empty(); }));
    }
    out.notes = {
        fmt::format("{} runs, of which {} did not converge: 0.5 to 0.9 V in steps of 50 mV, each at -55, -40, -20, 0, 27, 50, 75, 85, 100 "
                    "and 125 C; with hv_membrane=0 only the two axes through 0.7 V, 27 C. A range ends before the first condition, from "
                    "the nominal point outwards, that does not satisfy it.",
                    runs, failed_runs),
        "Spike counts are given as protraction / plateau / retraction / after. A working chip is silent at rest. A working SA-I fires "
        "while the force rises and in the last 100 ms of the plateau, but not after retraction. A working FA-I fires in both ramps, but "
        "not in those 100 ms.",
        fmt::format("A chip is within the limits if it is silent at rest, and if its number of spikes in each other phase differs from the "
                    "model's by at most a quarter, or by one spike: {} (SA-I), {} (FA-I).",
                    all[0].limits_text(), all[1].limits_text()),
        "The thesis gives ranges for its bias generator only: 550 to 800 mV and -55 to 95 C, typical; 650 to 750 mV over corners (E.2). "
        "Bias currents are ideal here, so supply and temperature affect only the chips' transistors."};
    return out;
}

const Study study{
    "range", "Working range of the chips: supply, temperature, process corners",
    "Between which supplies and temperatures do the two chips fire as designed under the press stimulus, and what limits them? Thesis E.2",
    ClaimKind::predicted, compute};

}  // namespace corpuscle::studies::range
