#pragma once
// Encodes the frames of skin maps for skin-data.js as compact base64 text.

#include <nlohmann/json.hpp>

#include "report/envelope.hpp"
#include "report/skin/binned_frames.hpp"

namespace corpuscle {

/// The bytes of the values in base64.
template <class T>
std::string array64(const std::vector<T>& values) {
    return base64(values.data(), values.size() * sizeof(T));
}

/// Variable-length integers (LEB128): seven bits per byte, the lowest bits first; the byte's highest bit is set if more bytes follow.
class PackedNumbers {
public:
    std::vector<unsigned char> bytes;
    void append_number(std::uint64_t n) {
        for (; n >= 128; n >>= 7) bytes.push_back(static_cast<unsigned char>(n | 128));
        bytes.push_back(static_cast<unsigned char>(n));
    }
    /// Encodes a frame as one level per place: levels 1 to 254 as one byte, larger ones as 255 and the level as a number, runs of places
    /// with level 0 as 0 and their number. `level` converts an entry's value to its level, at least 1.
    template <class Frame, class Level>
    void append_frame(const Frame& f, std::size_t places, Level level) {
        std::size_t at = 0;
        const auto zeros_to = [&](std::size_t place) {
            if (place > at) bytes.push_back(0), append_number(place - at);
            at = place + 1;
        };
        for (const auto& [place, value] : f) {
            zeros_to(place);
            const std::uint64_t n = level(value);
            bytes.push_back(static_cast<unsigned char>(std::min<std::uint64_t>(n, 255)));
            if (n >= 255) append_number(n);
        }
        zeros_to(places);
    }
};

/// Spike counts in frames. `T`: sampling period, s.
nlohmann::ordered_json frames_document(const BinnedFrames<std::uint32_t>& counts, double T);

/// Mean force of each mark of sites in each frame, in steps of 1/254 of the maximum ("max", N). `sites`: the force of each mark, summed
/// over the samples of the frame. `samples`: length of the run, because the last frame may be incomplete.
nlohmann::ordered_json force_document(const BinnedFrames<double>& sites, double T, std::int64_t samples);

}  // namespace corpuscle
