#pragma once
// Helpers for sinks: they make the files of output formats, and pass spikes to sinks as a run does.

#include "run/channels/channel_population.hpp"
#include "run/sinks.hpp"
#include "support/support.hpp"

namespace corpuscle {
extern const OutputFormat spikes_format, events_format, copies_format, afferents_format, npz_format, sound_format, probes_format,
    vectors_format, trials_format, nwb_format;
}

namespace corpuscle::test {

/// The sink of a format that writes into a folder.
inline std::unique_ptr<FileSink> make_sink(const OutputFormat& format, const std::string& directory, OutputRequest request = {}) {
    request.directory = directory;
    return value_or_throw(format.make(request));
}

inline void require(const Result<void>& result) {
    if (!result) throw std::runtime_error(result.error().text());
}

/// Passes spikes to sinks in blocks of `block` samples, as the run of afferents on channels does. The force is 0.
inline void pass_to_sinks(const ForceSource& source, std::span<const AfferentPlan> plans, std::vector<Spike> spikes, std::int64_t samples,
                          std::int64_t block, const std::vector<Sink*>& sinks) {
    const ChannelPopulation population(source, plans, source.name());
    const auto input = make_input(population, source.name(), source);
    const std::vector<double> zeros(static_cast<std::size_t>(block));
    std::sort(spikes.begin(), spikes.end());
    for (auto* sink : sinks) require(sink->begin(input));
    for (std::int64_t first = 0; first < samples; first += block) {
        const auto steps = static_cast<std::size_t>(std::min(block, samples - first));
        const std::vector<std::span<const double>> force(population.channels(), std::span(zeros).first(steps));
        std::vector<Spike> in_block;
        for (const auto& s : spikes)
            if (s.step >= first && s.step < first + block) in_block.push_back(s);
        for (auto* sink : sinks) require(sink->block(input, {first, steps, force, {}, in_block}));
    }
    for (auto* sink : sinks) require(sink->end(input, samples, {}));
}

}  // namespace corpuscle::test
