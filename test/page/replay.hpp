#pragma once
// Recordings that a page engine replays.

#include <fmt/format.h>

#include "core/random.hpp"
#include "page/ask.hpp"

namespace corpuscle::page {

inline std::vector<std::uint8_t> file_of(const std::string& text) { return {text.begin(), text.end()}; }

/// A CSV recording in N with this force at each sample.
template <class Force>
std::string recording(std::size_t samples, double rate, double t0, Force force) {
    std::string text = "time_s,force_N\n";
    for (std::size_t k = 0; k < samples; ++k) text += fmt::format("{:.6f},{:.6f}\n", t0 + static_cast<double>(k) / rate, force(k));
    return text;
}

/// The noise of a sensor, N, at sample k.
inline double noise_at(std::size_t k) { return 5e-3 * normal_pair(3, static_cast<std::uint32_t>(k), 1, 0).first; }

/// The answers to `read` and `respond` for a recording.
struct Replay {
    PageAnswer read, respond;

    static Replay of(const std::string& name, const std::string& text, const std::string& rows) {
        PageEngine engine;
        auto read = ask(engine, fmt::format(R"({{"request": "read", "name": "{}", "keep": true}})", name), "file", file_of(text));
        EXPECT_EQ(read.error(), "");
        return {std::move(read), ask_well(engine, fmt::format(R"({{"request": "respond", "channel": 0, "rows": [{}]}})", rows))};
    }
    std::string warnings() const {
        std::string out;
        for (const auto& warning : respond["warnings"]) out += warning.get<std::string>() + "\n";
        return out;
    }
};

}  // namespace corpuscle::page
