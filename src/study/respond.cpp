#include "study/respond.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "study/units.hpp"

namespace corpuscle {
namespace {

std::string unique_name(std::span<const std::unique_ptr<Source>> sources, std::size_t n) {
    int same = 1;
    for (std::size_t k = 0; k < n; ++k) same += sources[k]->name() == sources[n]->name();
    return same == 1 ? sources[n]->name() : fmt::format("{} ({})", sources[n]->name(), same);
}

}  // namespace

std::string Input::channel_name(std::size_t channel) const {
    const auto& own = source.channels()[channel].name;
    return of == 1 ? own : own == source.name() ? name : name + ":" + own;
}

Result<Work> respond(std::span<const std::unique_ptr<Source>> sources, std::span<const AfferentPlan> afferents,
                     std::span<Listener* const> listeners, const RespondOptions& options) {
    const bool probed = std::any_of(listeners.begin(), listeners.end(), [](const Listener* l) { return l->wants_probes(); });
    Work work;
    Pool alone(1);
    Pool& pool = options.pool ? *options.pool : alone;
    std::uint32_t unit = 0;
    for (std::size_t n = 0; n < sources.size(); ++n) {
        auto& source = *sources[n];
        auto made = Units::make({source, unique_name(sources, n), afferents, {}, unit, n, sources.size()}, options, probed);
        if (!made) return made.error();
        Units& units = *made;
        for (auto* listener : listeners)
            if (auto ok = listener->begin(units.input()); !ok) return ok.error();
        for (;;) {
            const auto more = units.answer_block(source, listeners, pool, work);
            if (!more) return more.error();
            if (!*more) break;
            if (!options.keep_on((static_cast<double>(n) + source.done()) / static_cast<double>(sources.size())))
                return Error{Code::interrupted, "interrupted"};
        }
        for (auto& sentence : units.outside()) work.outside.push_back(std::move(sentence));
        if (units.samples() == 0) return bad_input("no samples of force", {source.name()});
        for (auto* listener : listeners)
            if (auto ok = listener->end(units.input(), units.samples()); !ok) return ok.error();
        unit += static_cast<std::uint32_t>(units.input().units());
    }
    return work;
}

std::vector<std::string> noise_warnings(std::span<const AfferentPlan> afferents, double noise) {
    std::vector<std::string> warnings;
    for (const auto& a : afferents)
        if (noise > 0 && (a.design || !a.converter.empty()))
            warnings.push_back(
                fmt::format("{}: --noise does not reach it; {}", a.name,
                            a.design ? "a netlist has no membrane but its own" : "behind a converter membranes are numbers"));
    return warnings;
}

std::vector<std::string> work_warnings(const Work& work) {
    std::vector<std::string> warnings;
    if (work.capped_steps > 0)
        warnings.push_back(
            fmt::format("{} steps would have held more spikes than one step can ({}, or 1 behind a converter) and were cut "
                        "short; raise the rate, or the threshold",
                        work.capped_steps, spikes_a_step));
    if (work.clipped > 0)
        warnings.push_back(
            fmt::format("{} samples were clipped by a transducer or a converter: the afferent saw less force than there "
                        "was; lower R_fb or V_FSR, raise V_DD or I_max, or widen F_low to F_high",
                        work.clipped));
    if (work.overflowed > 0)
        warnings.push_back(fmt::format(
            "{} results did not fit their words and were kept at the largest or least; lower frac, or raise word", work.overflowed));
    warnings.insert(warnings.end(), work.outside.begin(), work.outside.end());
    for (const auto& error : work.lost) warnings.push_back("did not converge, and said no more: " + error.text());
    return warnings;
}

std::vector<std::string> rate_warnings(std::span<const std::unique_ptr<Source>> sources, std::span<const AfferentPlan> afferents) {
    std::vector<std::string> warnings;
    for (const auto& source : sources)
        for (const auto& a : afferents)
            if (const double rate = source->clock().rate(); rate < a.least_rate)
                warnings.push_back(fmt::format(
                    "{} on {}: the samples come at {:g} Hz, but what it answers to needs {:g} Hz or more; do not trust its spikes", a.name,
                    source->name(), rate, a.least_rate));
    return warnings;
}

}  // namespace corpuscle
