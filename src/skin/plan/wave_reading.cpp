// Reads the contact wave of a class from a population file: the keys wave_speed, wave_decay ...

#include <fmt/format.h>

#include "skin/plan/population_values.hpp"

namespace corpuscle::skins {
namespace {

/// One key of a wave, and the range of its values.
struct WaveKey {
    std::string_view name, unit;
    double WaveParams::* member;
    double low, high;
};

constexpr WaveKey wave_keys[] = {{"wave_speed", "m/s", &WaveParams::speed, 0.5, 200},
                                 {"wave_decay", "m", &WaveParams::decay, 1e-3, 0.2},
                                 {"wave_radius", "m", &WaveParams::radius, 1e-4, 0.1},
                                 {"wave_gain", "", &WaveParams::gain, 0, 10},
                                 {"wave_corner", "Hz", &WaveParams::corner, 0.01, 1000}};

}  // namespace

Result<WaveParams> read_wave(const ConfigNode& in, const PopulationValues& values) {
    WaveParams out;
    for (const auto& key : wave_keys) {
        if (!in.has(key.name)) continue;
        if (!in.has("wave_speed"))
            return in.get(key.name)->error_here(fmt::format("{} needs a wave_speed: wave_speed = \"8 m/s\"", key.name));
        out.*key.member = TRY(values.number(*in.get(key.name), key.name, key.unit, key.low, key.high));
    }
    return out;
}

}  // namespace corpuscle::skins
