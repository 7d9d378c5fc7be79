// Reads the data of a fit to spikes: forces, and for each a file of the trains that were recorded under it.

#include <fmt/format.h>
#include <algorithm>

#include "cli/fit/fit_arguments.hpp"
#include "core/text/ascii_text.hpp"
#include "fit/spike_problem.hpp"
#include "io/spikes/spike_files.hpp"

namespace corpuscle {
namespace {

std::string list_names(const std::vector<NamedTrain>& trains) {
    constexpr std::size_t most = 8;
    std::vector<std::string> names;
    for (const auto& t : trains)
        if (names.size() < most) names.push_back(t.name().empty() ? "(without a name)" : t.name());
    return joined(names) + (trains.size() > most ? fmt::format(" and {} more", trains.size() - most) : "");
}

bool matches(const NamedTrain& train, const std::string& name) {
    return train.name() == name || train.afferent == name || train.channel == name;
}

/// The trains that --train names; without it the only one.
Result<std::vector<NamedTrain>> select_trains(std::vector<NamedTrain> all, const std::vector<std::string>& wanted,
                                              const std::string& file) {
    if (all.empty()) return bad_input("no spikes in this file", {file});
    if (wanted.empty()) {
        if (all.size() == 1) return all;
        return bad_usage(
            fmt::format("{}: has {} trains; choose those of one afferent by --train NAME: {}", file, all.size(), list_names(all)));
    }
    std::vector<NamedTrain> out;
    for (const auto& name : wanted)
        if (std::none_of(all.begin(), all.end(), [&](const NamedTrain& t) { return matches(t, name); }))
            return bad_usage(fmt::format("--train {}: {} has no such train; it has {}", name, file, list_names(all)));
    for (auto& train : all)
        if (std::any_of(wanted.begin(), wanted.end(), [&](const auto& name) { return matches(train, name); }))
            out.push_back(std::move(train));
    return out;
}

/// Reads all channels of a source: force[channel][sample].
Result<std::vector<std::vector<double>>> read_channels(ForceSource& source) {
    std::vector<std::vector<double>> out(source.channels().size());
    for (Frames block(out.size(), 4096);;) {
        TRY(source.read(block));
        if (block.count == 0) return out;
        for (std::size_t c = 0; c < out.size(); ++c)
            out[c].insert(out[c].end(), block.force[c].begin(), block.force[c].begin() + static_cast<std::ptrdiff_t>(block.count));
    }
}

/// Assigns each train to the channel that it names. With a single channel, all trains are its repetitions.
Result<std::vector<SpikeRecording>> pair_channels(ForceSource& source, std::vector<NamedTrain> trains, const std::string& file,
                                                  double delay) {
    auto force = TRY(read_channels(source));
    std::vector<SpikeRecording> out;
    const auto& channels = source.channels();
    for (std::size_t c = 0; c < channels.size(); ++c) {
        const auto name = channels.size() == 1 ? source.name() : fmt::format("{} {}", source.name(), channels[c].name);
        out.push_back(
            {.name = name, .force = std::move(force[c]), .clock = source.clock(), .trains = {}, .spike_file = file, .delay = delay});
    }
    for (auto& t : trains) {
        const auto at = std::find_if(channels.begin(), channels.end(), [&](const Channel& c) { return c.name == t.channel; });
        if (at == channels.end() && channels.size() > 1)
            return bad_usage(fmt::format("{}: the train '{}' names none of the {} channels of {}; choose its channel by --channel", file,
                                         t.name(), channels.size(), source.name()));
        for (double& x : t.times) x -= delay;
        auto& recording = out[channels.size() == 1 ? 0 : static_cast<std::size_t>(at - channels.begin())];
        recording.trains.push_back({t.name(), std::move(t.times)});
    }
    std::erase_if(out, [](const SpikeRecording& r) { return r.trains.empty(); });
    return out;
}

}  // namespace

Result<std::unique_ptr<FitProblem>> read_spike_problem(const FitArguments& args, const AfferentPlan& plan,
                                                       std::vector<ParameterOverride>& unused) {
    if (args.forces.size() != args.spike_files.size())
        return bad_usage(
            fmt::format("fit afferent: {} forces but {} files of spikes; give one --spikes FILE for each FORCE, in their order",
                        args.forces.size(), args.spike_files.size()));
    std::vector<SpikeRecording> recordings;
    for (std::size_t k = 0; k < args.forces.size(); ++k) {
        auto source = TRY(args.forces[k].open(args.recording, args.settings, FitArguments::default_rate, args.seed));
        keep_unused(unused, source.unused);
        auto trains = TRY(read_spikes(args.spike_files[k]));
        auto selected = TRY(select_trains(std::move(trains), args.trains, args.spike_files[k]));
        for (auto& r : TRY(pair_channels(*source.result, std::move(selected), args.spike_files[k], args.delay)))
            recordings.push_back(std::move(r));
    }
    hold_out(recordings, args.hold_out);
    return make_spike_problem(std::move(recordings), {.tau = args.tau, .is_irregular = plan.traits().is_irregular});
}

}  // namespace corpuscle
