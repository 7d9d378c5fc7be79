#include "run/afferent_run.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "run/input_simulator.hpp"

namespace corpuscle {
namespace {

/// The name of source n of a run. If earlier sources have the same name, a number is appended: "press (2)".
std::string unique_name(std::span<const std::unique_ptr<ForceSource>> sources, std::size_t n) {
    int same = 1;
    for (std::size_t k = 0; k < n; ++k) same += sources[k]->name() == sources[n]->name();
    return same == 1 ? sources[n]->name() : fmt::format("{} ({})", sources[n]->name(), same);
}

}  // namespace

std::string Input::channel_name(std::size_t channel) const {
    const auto& name_in_source = source.channels()[channel].name;
    return input_count == 1 ? name_in_source : name_in_source == source.name() ? name : name + ":" + name_in_source;
}

Result<RunStats> respond(std::span<const std::unique_ptr<ForceSource>> sources, std::span<const AfferentPlan> afferents,
                         std::span<ResponseSink* const> sinks, const RespondOptions& options) {
    const bool wants_probes = std::any_of(sinks.begin(), sinks.end(), [](const ResponseSink* sink) { return sink->wants_probes(); });
    RunStats stats;
    ThreadPool single_thread(1);
    ThreadPool& pool = options.pool ? *options.pool : single_thread;
    std::uint32_t first_afferent = 0;
    for (std::size_t n = 0; n < sources.size(); ++n) {
        auto& source = *sources[n];
        auto simulator = InputSimulator::make({source, unique_name(sources, n), afferents, {}, first_afferent, n, sources.size()}, options,
                                              wants_probes);
        if (!simulator) return simulator.error();
        for (auto* sink : sinks)
            if (auto ok = sink->begin(simulator->input()); !ok) return ok.error();
        for (;;) {
            const auto more = simulator->simulate_block(source, sinks, pool, stats);
            if (!more) return more.error();
            if (!*more) break;
            if (!options.should_continue((static_cast<double>(n) + source.progress()) / static_cast<double>(sources.size())))
                return Error{ErrorCode::interrupted, "interrupted"};
        }
        for (auto& warning : simulator->range_warnings()) stats.range_warnings.push_back(std::move(warning));
        if (simulator->samples() == 0) return bad_input("no samples of force", {source.name()});
        for (auto* sink : sinks)
            if (auto ok = sink->end(simulator->input(), simulator->samples()); !ok) return ok.error();
        first_afferent += static_cast<std::uint32_t>(simulator->input().afferent_count());
    }
    return stats;
}

std::vector<std::string> noise_warnings(std::span<const AfferentPlan> afferents, double noise) {
    std::vector<std::string> warnings;
    for (const auto& a : afferents)
        if (noise > 0 && (a.factory || !a.converter.empty()))
            warnings.push_back(fmt::format("{}: --noise has no effect; {}", a.name,
                                           a.factory ? "a netlist has no model membrane" : "behind a converter the membrane is digital"));
    return warnings;
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

std::vector<std::string> rate_warnings(std::span<const std::unique_ptr<ForceSource>> sources, std::span<const AfferentPlan> afferents) {
    std::vector<std::string> warnings;
    for (const auto& source : sources)
        for (const auto& a : afferents)
            if (const double rate = source->clock().rate(); rate < a.min_rate)
                warnings.push_back(
                    fmt::format("{} on {}: the sample rate is {:g} Hz, but this afferent needs {:g} Hz or more; do not trust its spikes",
                                a.name, source->name(), rate, a.min_rate));
    return warnings;
}

}  // namespace corpuscle
