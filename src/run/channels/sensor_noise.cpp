#include "run/channels/sensor_noise.hpp"

#include <fmt/format.h>

#include "core/random.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"
#include "io/quality/deadband.hpp"
#include "run/firing_factor.hpp"

namespace corpuscle {
namespace {

/// Two seconds of white noise with this standard deviation (N), at most 20,000 samples.
std::vector<double> white_noise(double deviation, double rate) {
    constexpr std::uint64_t seed = 1;
    std::vector<double> out(static_cast<std::size_t>(std::min(2 * rate, 20e3)));
    for (std::uint32_t k = 0; k < out.size(); ++k)
        out[k] = deviation * normal_pair(seed, k, static_cast<std::uint32_t>(stream_id("sensor noise")), 0).first;
    return out;
}

/// A channel, and the standard deviation of its noise.
struct NoisyChannel {
    std::string name = "";
    double deviation = 0;  ///< N
};

/// The noisiest of the channels whose noise is not inside a deadband.
NoisyChannel noisiest_channel(std::span<const Channel> channels, const RecordingQuality& quality) {
    constexpr double min_band = 2;  // standard deviations; a narrower band lets the noise pass
    std::vector<double> bands(channels.size(), 0);
    for (const auto& m : quality.metrics)
        if (m.name == "deadband") bands[m.channel] = m.value;
    NoisyChannel out;
    for (const auto& m : quality.metrics)
        if (m.name == "noise" && m.value > out.deviation && bands[m.channel] < min_band * m.value)
            out = {channels[m.channel].name, m.value};
    return out;
}

}  // namespace

std::string sensor_noise_warning(std::span<const Channel> channels, const RecordingQuality& quality, double rate,
                                 std::span<const NoiseSubject> subjects, const SimulationOptions& run) {
    const auto [channel, deviation] = noisiest_channel(channels, quality);
    if (!(deviation > 0)) return "";
    const auto noise = white_noise(deviation, rate);
    std::vector<std::string> firing;
    for (const auto& s : subjects)
        if (s.plan->traits().can_search_factor && fires(*s.plan, run, noise)) firing.push_back(s.name);
    if (firing.empty()) return "";
    return fmt::format(
        "the noise of the sensor, about {} on '{}'{}, is enough to make {} fire. Use --zero 500ms --deadband auto if nothing touches the "
        "sensor in the first half second, otherwise --deadband {}mN",
        format_quantity(deviation, "N"), channel, channels.size() > 1 ? fmt::format(" (the worst of {} channels)", channels.size()) : "",
        joined(firing), format_rounded_up(Deadband::max_noise * deviation * 1e3));
}

std::string sensor_noise_warning(const ForceSource& source, std::span<const NoiseSubject> subjects, const SimulationOptions& run) {
    return sensor_noise_warning(source.channels(), source.quality(), source.clock().rate(), subjects, run);
}

}  // namespace corpuscle
