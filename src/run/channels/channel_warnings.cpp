#include "run/channels/channel_warnings.hpp"
#include "core/text/quantity.hpp"

#include <fmt/format.h>
#include <cmath>
#include <limits>

#include "measure/measures.hpp"
#include "model/neuron/threshold_crossing.hpp"

namespace corpuscle {

std::vector<std::string> noise_warnings(std::span<const AfferentPlan> afferents, double noise) {
    std::vector<std::string> warnings;
    for (const auto& a : afferents)
        if (const auto reason = a.traits().reason_no_noise; noise > 0 && !reason.empty())
            warnings.push_back(fmt::format("{}: --noise has no effect; {}", a.name, reason));
    return warnings;
}

std::vector<std::string> equal_chips_warnings(std::span<const AfferentPlan> afferents) {
    std::vector<std::string> warnings;
    for (const auto& a : afferents)
        if (const auto reason = a.traits().reason_no_chips; !reason.empty()) warnings.push_back(fmt::format("{}: {}", a.name, reason));
    return warnings;
}

std::string range_warning(const std::string& afferent, const std::string& channel, const ValidRange& range, const RangeViolation& violation,
                          std::int64_t samples, const Clock& clock) {
    const double T = clock.T();
    return fmt::format("{} on {}: {}", afferent, channel,
                       range_violation_message(range, static_cast<double>(violation.samples) * T, static_cast<double>(samples) * T,
                                               clock.t0 + static_cast<double>(violation.first_sample) * T));
}

std::vector<std::string> response_warnings(const RunStats& stats) {
    std::vector<std::string> warnings;
    if (stats.truncated_steps > 0)
        warnings.push_back(
            fmt::format("{} steps had more spikes than one step can hold ({}, or 1 behind a converter) and were "
                        "truncated; raise the sample rate, or the threshold of the neuron",
                        stats.truncated_steps, max_spikes_per_step));
    if (stats.saturated > 0)
        warnings.push_back(
            fmt::format("{} samples saturated a transducer or a converter, so the afferent received less force than was "
                        "applied; lower R_fb or V_FSR, raise V_DD or I_max, or widen F_low to F_high",
                        stats.saturated));
    if (stats.overflowed > 0)
        warnings.push_back(
            fmt::format("{} results overflowed their words and were set to the largest or smallest value; lower frac, or raise word",
                        stats.overflowed));
    warnings.insert(warnings.end(), stats.range_warnings.begin(), stats.range_warnings.end());
    for (const auto& error : stats.diverged) warnings.push_back("did not converge, and gave no more spikes: " + error.text());
    return warnings;
}

std::string rate_warning(const AfferentPlan& plan, const std::string& subject, double rate) {
    if (!(rate < plan.min_rate * (1 - 1e-9))) return "";  // a rate that is computed from times may be slightly too small
    return fmt::format(
        "{}: the sample rate is {:g} Hz, but this afferent needs {:g} Hz or more: vibration above {:g} Hz is missing, and the "
        "afferent responds to the slower part of the force only",
        subject, rate, plan.min_rate, rate / 2);
}

std::string source_rate_warning(const AfferentPlan& plan, const std::string& source, double rate) {
    return rate_warning(plan, fmt::format("{} on {}", plan.name, source), rate);
}

std::vector<std::string> rate_warnings(std::span<const std::unique_ptr<ForceSource>> sources, std::span<const AfferentPlan> afferents) {
    std::vector<std::string> warnings;
    for (const auto& source : sources)
        for (const auto& a : afferents)
            if (auto warning = source_rate_warning(a, source->name(), source->clock().rate()); !warning.empty())
                warnings.push_back(std::move(warning));
    return warnings;
}

std::string excessive_rate_warning(double rate, double T, const AfferentPlan& plan, const std::string& name) {
    const auto refractory = plan.value("t_ref");
    // An afferent with the refractory time of a nerve cannot fire too fast. Then the samples are too far apart.
    if (rate * T > 1 && refractory && *refractory >= 1 / max_nerve_rate)
        return fmt::format(
            "several spikes come within one sample of {}, so their rates are left out; record at {} or more, or read a "
            "recording with --resample 2kHz --interpolation smooth",
            format_quantity(T, "s"), format_quantity(max_nerve_rate, "Hz"));
    const auto advice = refractory && *refractory < 1 / max_nerve_rate
                            ? fmt::format(", and give the afferent a refractory period: --set {}.t_ref=1ms", name)
                            : std::string();
    const auto spikes = rate * T <= 1
                            ? fmt::format("spikes come at up to {}", format_quantity(rate, "Hz"))
                            : fmt::format("several spikes come within one sample of {}, which is not a rate", format_quantity(T, "s"));
    return fmt::format("{}; a nerve fibre fires at no more than about {}; check the force's unit and size{}", spikes,
                       format_quantity(max_nerve_rate, "Hz"), advice);
}

double highest_rate(std::vector<double> values, double T) {
    return remove_unresolved_rates(values, T) ? std::numeric_limits<double>::infinity() : values[measure_index<PeakRate>()];
}

std::string channel_rate_warning(double rate, double T, const AfferentPlan& plan, const std::string& channel) {
    if (!(rate > max_nerve_rate)) return "";
    return fmt::format("{}: on {} {}", plan.name, channel, excessive_rate_warning(rate, T, plan, plan.name));
}

}  // namespace corpuscle
