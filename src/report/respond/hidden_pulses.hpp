#pragma once
// Spikes of a circuit that do not show in the curve of its spike output, because its pulses are shorter than the samples of the curve.

#include <fmt/format.h>
#include <optional>
#include <span>

#include "core/afferent_factory.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle {

/// Counts how often the curve of a circuit's spike output crosses the level of its spikes.
class HiddenPulses {
    std::optional<std::size_t> probe_;  // index of the spike output among the probes; nothing if it is not recorded
    std::string_view name_;
    double level_ = 0;
    std::optional<bool> is_above_;  // at the last sample
    std::size_t crossings_ = 0;     // of the curve, upwards and downwards

public:
    HiddenPulses(const AfferentPlan& plan, std::span<const Probe> probes) {
        const auto traits = plan.traits();
        name_ = traits.spike_probe, level_ = traits.spike_level;
        for (std::size_t p = 0; p < probes.size() && !name_.empty(); ++p)
            if (probes[p].name == name_) probe_ = p;
    }
    bool uses(std::size_t probe) const { return probe_ == probe; }
    void add(double value) {
        const bool is_above = value > level_;
        crossings_ += is_above_.value_or(is_above) != is_above;
        is_above_ = is_above;
    }
    /// A sentence for the page if spikes do not show; "" if all do. `T`: time between the samples, s.
    std::string note(std::size_t spikes, double T) const {
        const auto shown = (crossings_ + 1) / 2;  // the force may end within a pulse
        if (!probe_ || shown >= spikes) return "";
        return fmt::format(
            "{} of its {} spikes do not show in the curve of {}: their pulses are shorter than the time between its samples, "
            "{}. The spikes themselves are complete",
            spikes - shown, spikes, name_, format_quantity(T, "s"));
    }
};

}  // namespace corpuscle
