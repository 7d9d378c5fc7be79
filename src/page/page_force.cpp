#include "page/page_force.hpp"

#include <fmt/format.h>

#include "core/stimulus/stimuli.hpp"
#include "page/session.hpp"

namespace corpuscle::page {
namespace {

constexpr std::size_t max_samples = 20'000'000;

/// As read_channel(), but a source that is too long is an error before it fills the memory.
Result<std::vector<double>> read_bounded(ForceSource& source) {
    std::vector<double> out;
    for (Frames block(1, 4096);;) {
        TRY(source.read(block));
        if (block.count == 0) return out;
        if (out.size() + block.count > max_samples)
            return bad_input(fmt::format("the stimulus has more than {} samples; shorten it, or lower the rate", max_samples));
        out.insert(out.end(), block.force[0].begin(), block.force[0].begin() + static_cast<std::ptrdiff_t>(block.count));
    }
}

/// "F_max=2N" is a setting of the stimulus; in a sum, "press.F_max=2N".
Result<std::vector<ParameterOverride>> stimulus_overrides(const std::string& stimulus, std::span<const std::string> set) {
    std::vector<ParameterOverride> out;
    for (const auto& setting : set) {
        const bool has_target = setting.substr(0, setting.find('=')).find('.') != std::string::npos;
        auto parsed = TRY(parse_override(has_target ? setting : stimulus + "." + setting));
        parsed.typed = setting;
        out.push_back(std::move(parsed));
    }
    return out;
}

/// The force of a channel of a recording.
Result<PageForce> channel_force(ObjectReader& request, const KeptRecording* recording) {
    if (!recording)
        return bad_input(
            fmt::format("{}: there is no recording for \"channel\"; send the request \"read\" with \"keep\": true first", request.name()));
    const auto channel = static_cast<std::uint32_t>(TRY(request.integer("channel", 0, recording->channels.size() - 1)));
    for (const char* other : {"rate", "stimulus", "stimulus_set"})
        if (request.has(other))
            return bad_input(fmt::format("{}: give either \"channel\", of the recording, or \"{}\"", request.name(), other));
    PageForce out;
    out.clock = recording->clock, out.values = recording->force[channel];
    out.source = recording->name, out.channel = recording->channels[channel].name;
    out.quality = recording->quality_of(channel);
    return out;
}

/// The force of a stimulus, or of the array of the request.
Result<PageForce> stimulus_force(ObjectReader& request, std::uint64_t seed) {
    PageForce out;
    out.clock = TRY(read_clock(request));
    const auto name = TRY(request.text("stimulus", ""));
    const auto set = TRY(request.texts("stimulus_set"));
    const auto* array = request.array("force");
    if (name.empty() == (array == nullptr))
        return bad_input(fmt::format("{}: give either a \"stimulus\" or the array \"force\"", request.name()));
    if (array) {
        out.values = std::make_shared<const std::vector<double>>(TRY(numbers_of(*array)));
        out.is_known = true;
        return out;
    }
    const auto overrides = TRY(stimulus_overrides(name, set));
    auto made = TRY(make_stimulus(name, overrides, out.clock.rate(), seed));
    const auto members = stimulus_members(name);
    TRY(check_all_used(made.unused, members));
    out.phases = made.result->phases();
    out.source = made.result->name(), out.channel = made.result->channels().front().name;
    out.values = std::make_shared<const std::vector<double>>(TRY(read_bounded(*made.result)));
    return out;
}

}  // namespace

Result<PageForce> read_force(ObjectReader& request, const KeptRecording* recording) {
    const auto seed = TRY(request.integer("seed", 0, 1ULL << 53, 0));
    auto out = TRY(request.has("channel") ? channel_force(request, recording) : stimulus_force(request, seed));
    out.seed = seed;
    return out;
}

}  // namespace corpuscle::page
