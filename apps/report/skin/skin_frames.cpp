#include "report/skin/skin_frames.hpp"

#include <cmath>

namespace corpuscle {

nlohmann::ordered_json frames_document(const BinnedFrames<std::uint32_t>& counts, double T) {
    PackedNumbers bytes;
    const auto frames = counts.frames();
    for (const auto& f : frames) bytes.append_frame(f, counts.places(), [](std::uint32_t n) { return std::uint64_t{n}; });
    return {{"count", frames.size()},
            {"width", static_cast<double>(counts.width()) * T},
            {"places", counts.places()},
            {"data", array64(bytes.bytes)}};
}

nlohmann::ordered_json force_document(const BinnedFrames<double>& sites, double T, std::int64_t samples) {
    const auto frames = sites.frames();
    // the number of samples in frame k
    const auto length = [&](std::size_t k) {
        return static_cast<double>(std::clamp<std::int64_t>(samples - static_cast<std::int64_t>(k) * sites.width(), 1, sites.width()));
    };
    double max = 0;  // mean force of a mark in a frame, N
    for (std::size_t k = 0; k < frames.size(); ++k)
        for (const auto& e : frames[k]) max = std::max(max, e.value / length(k));
    PackedNumbers bytes;
    for (std::size_t k = 0; k < frames.size(); ++k)
        bytes.append_frame(frames[k], sites.places(), [&](double sum) {
            const double fraction = max > 0 ? sum / length(k) / max : 0;
            return fraction > 0 ? static_cast<std::uint64_t>(std::clamp(std::lround(254 * fraction), 1L, 254L)) : std::uint64_t{0};
        });
    return {{"count", frames.size()},
            {"width", static_cast<double>(sites.width()) * T},
            {"places", sites.places()},
            {"max", max},
            {"data", array64(bytes.bytes)}};
}

}  // namespace corpuscle
