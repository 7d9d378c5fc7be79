#include "reproduction/thesis/chip_range.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace corpuscle {
namespace {

PhaseCounts counts_of(const std::vector<double>& train) {
    return {press::spike_count(train, press::rest), press::spike_count(train, press::protraction),
            press::spike_count(train, press::plateau), press::spike_count(train, press::retraction),
            press::spike_count(train, press::after)};
}

bool is_working(std::string_view chip, const std::vector<double>& t) {
    if (press::spike_count(t, press::rest) > 0 || press::spike_count(t, press::protraction) == 0) return false;
    if (chip.starts_with("sa1")) return press::spike_count(t, press::plateau_end) > 0 && press::spike_count(t, press::after) == 0;
    return press::spike_count(t, press::plateau_end) == 0 && press::spike_count(t, press::retraction) > 0;
}

bool is_within_limits(const ChipRange& range, const PhaseCounts& counts) {
    for (std::size_t k = 0; k < counts.size(); ++k)
        if (const auto [min, max] = range.limits(k); counts[k] < min || counts[k] > max) return false;
    return true;
}

}  // namespace

const ConditionTrial& ChipRange::at(const ChipCondition& condition) const {
    return *std::find_if(trials.begin(), trials.end(), [&](const ConditionTrial& t) { return t.response.condition == condition; });
}

std::pair<double, double> ChipRange::limits(std::size_t phase) const {
    const double spikes = model.at(phase), difference = phase == 0 ? 0 : std::max(1.0, std::floor(spikes / 4));
    return {std::max(0.0, spikes - difference), spikes + difference};
}

std::string ChipRange::limits_text() const {
    std::string out;
    for (std::size_t k = 1; k < model.size(); ++k) {
        const auto [min, max] = limits(k);
        out += fmt::format("{}{:g} to {:g}", out.empty() ? "" : " / ", min, max);
    }
    return out;
}

Result<ChipRange> explore_range(const std::string& chip, const std::vector<ChipCondition>& conditions,
                                const std::function<bool(double)>& progress) {
    const auto model = TRY(simulate_train({chip.substr(0, chip.find('-'))}));
    ChipRange out{chip, counts_of(model), {}};
    const auto total = static_cast<double>(conditions.size());
    auto responses =
        TRY(run_conditions(chip, conditions, [&](std::size_t finished) { return progress(static_cast<double>(finished) / total); }));
    for (auto& r : responses) {
        const auto counts = counts_of(r.spikes);
        const bool converged = r.error.empty(), works = converged && is_working(chip, r.spikes);
        out.trials.push_back({std::move(r), counts, works, converged && is_within_limits(out, counts)});
    }
    return out;
}

}  // namespace corpuscle
