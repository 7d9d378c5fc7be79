#pragma once
// Frames of a skin's maps as the page reads them (skin-data.js): few bytes, as base64 text.

#include <nlohmann/json.hpp>

#include "report/envelope.hpp"
#include "report/framed.hpp"

namespace corpuscle {

template <class T>
std::string array64(const std::vector<T>& values) {
    return base64(values.data(), values.size() * sizeof(T));
}

/// Whole numbers in as few bytes as they need: seven bits each, the lowest first, the highest bit says that more follow.
class PackedNumbers {
public:
    std::vector<unsigned char> all;
    void number(std::uint64_t n) {
        for (; n >= 128; n >>= 7) all.push_back(static_cast<unsigned char>(n | 128));
        all.push_back(static_cast<unsigned char>(n));
    }
    /// Of all places: 1 to 254 itself, 255 and a number for more, 0 and a number for so many zeros.
    template <class Frame, class Level>
    void frame(const Frame& f, std::size_t places, Level level) {
        std::size_t at = 0;
        const auto zeros_to = [&](std::size_t place) {
            if (place > at) all.push_back(0), number(place - at);
            at = place + 1;
        };
        for (const auto& [place, value] : f) {
            zeros_to(place);
            const std::uint64_t n = level(value);
            all.push_back(static_cast<unsigned char>(std::min<std::uint64_t>(n, 255)));
            if (n >= 255) number(n);
        }
        zeros_to(places);
    }
};

/// Counts in frames; T: of a sample, s.
nlohmann::ordered_json frames_document(const Framed<std::uint32_t>&, double T);

/// Mean force of each mark in each frame, in 254 parts of the greatest.
nlohmann::ordered_json force_document(const Framed<double>& sites, double T, std::int64_t samples);

}  // namespace corpuscle
