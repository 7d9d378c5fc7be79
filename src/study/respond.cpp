#include "study/respond.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace corpuscle {
namespace {

/// Fewer samples at a time where there are many channels, or many units that show their probes: some 64 MB of either.
std::size_t block_for(const Input& input, const RespondOptions& options, bool probed) {
    constexpr std::size_t most_values = std::size_t{1} << 23, probes = 8;
    const std::size_t values = probed ? input.units() * probes : input.source.channels().size();
    return std::clamp<std::size_t>(most_values / (values + 1), 1, options.block);
}

/// The units of one input at work.
class Bench {
    Input input_;
    std::vector<std::unique_ptr<Afferent>> afferents_;
    std::vector<std::span<const Probe>> probes_of_;
    std::vector<State> states_;
    std::vector<std::vector<std::vector<double>>> probes_;
    std::vector<Spike> spikes_;
    Frames force_;
    std::int64_t samples_ = 0;

public:
    Bench(Input input, const RespondOptions& options, bool probed)
        : input_(std::move(input)), force_(input_.source.channels().size(), block_for(input_, options, probed)) {
        const auto plans = input_.afferents;
        for (const auto& plan : plans) {
            afferents_.push_back(
                make_afferent(plan, {input_.source.clock().T(), options.method, options.sampled, options.noise, options.seed}));
            probes_of_.push_back(afferents_.back()->probes());
        }
        input_.probes = probes_of_;
        const auto channels = input_.source.channels().size();
        for (std::size_t u = 0; u < input_.units(); ++u) {
            states_.push_back(afferents_[u % plans.size()]->start(
                {static_cast<std::uint32_t>(input_.channel_of(u)), static_cast<std::uint32_t>(channels)}));
            if (probed) probes_.emplace_back(probes_of_[u % plans.size()].size(), std::vector<double>(force_.capacity));
        }
    }

    const Input& input() const { return input_; }
    std::int64_t samples() const { return samples_; }

    Result<void> answer_unit(std::size_t u, Work& work) {
        std::vector<double*> shown;
        if (!probes_.empty())
            for (auto& p : probes_[u]) shown.push_back(p.data());
        Answer answer{spikes_, input_.first_unit + static_cast<std::uint32_t>(u), shown, 0};
        const std::span<const double> force(force_.force[u / afferents_.size()].data(), force_.count);
        if (auto ok = afferents_[u % afferents_.size()]->respond(force, states_[u], answer); !ok) {
            auto error = ok.error();
            error.sentence =
                fmt::format("{} on {}: {}", input_.afferent_of(u).name, input_.channel_name(input_.channel_of(u)), error.sentence);
            return error;
        }
        work.capped_steps += answer.capped, work.clipped += answer.clipped, work.overflowed += answer.overflowed;
        return {};
    }

    /// One block through all units to all listeners; false at the end of the source.
    Result<bool> answer_block(Source& source, std::span<Listener* const> listeners, Work& work) {
        if (auto ok = source.read(force_); !ok) return ok.error();
        if (force_.count == 0) return false;
        spikes_.clear();
        for (std::size_t u = 0; u < input_.units(); ++u)
            if (auto ok = answer_unit(u, work); !ok) return ok.error();
        std::sort(spikes_.begin(), spikes_.end());
        const Answered answered{samples_, force_, spikes_, probes_};
        for (auto* listener : listeners)
            if (auto ok = listener->block(input_, answered); !ok) return ok.error();
        samples_ += static_cast<std::int64_t>(force_.count);
        const auto samples = static_cast<std::int64_t>(force_.count * force_.force.size());
        work.samples += samples;
        work.afferent_steps += samples * static_cast<std::int64_t>(afferents_.size());
        work.spikes += static_cast<std::int64_t>(spikes_.size());
        return true;
    }
};

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
    std::uint32_t unit = 0;
    for (std::size_t n = 0; n < sources.size(); ++n) {
        auto& source = *sources[n];
        Bench bench({source, unique_name(sources, n), afferents, {}, unit, n, sources.size()}, options, probed);
        for (auto* listener : listeners)
            if (auto ok = listener->begin(bench.input()); !ok) return ok.error();
        for (;;) {
            const auto more = bench.answer_block(source, listeners, work);
            if (!more) return more.error();
            if (!*more) break;
            if (!options.keep_on((static_cast<double>(n) + source.done()) / static_cast<double>(sources.size())))
                return Error{Code::interrupted, "interrupted"};
        }
        if (bench.samples() == 0) return bad_input("no samples of force", {source.name()});
        for (auto* listener : listeners)
            if (auto ok = listener->end(bench.input(), bench.samples()); !ok) return ok.error();
        unit += static_cast<std::uint32_t>(bench.input().units());
    }
    return work;
}

std::vector<std::string> noise_warnings(std::span<const AfferentPlan> afferents, double noise) {
    std::vector<std::string> warnings;
    for (const auto& a : afferents)
        if (noise > 0 && !a.converter.empty())
            warnings.push_back(fmt::format("{}: --noise does not reach it; behind a converter membranes are numbers", a.name));
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
