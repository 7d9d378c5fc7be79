// Reads how a class of a population file responds to tangential force.

#include <numbers>

#include "core/text/ascii_text.hpp"
#include "skin/plan/population_values.hpp"

namespace corpuscle::skins {
namespace {

constexpr double max_gain = 100, radians_per_degree = std::numbers::pi / 180;

}  // namespace

Result<DirectionTuning> read_direction_tuning(const ConfigNode& in, const PopulationValues& values) {
    DirectionTuning out;
    out.gain = TRY(values.number_of(in, "direction_gain", "", 0, max_gain));
    const auto *mean = in.get("direction"), *spread = in.get("direction_spread");
    for (const auto* key : {mean, spread})
        if (key && !in.has("direction_gain")) return key->error_here("a preferred direction needs a direction_gain: direction_gain = 0.5");
    if (spread && trimmed(spread->text) == "uniform") {
        if (mean)
            return mean->error_here("directions that are uniform have no mean; remove direction, or give direction_spread in degrees");
        return out;
    }
    if (spread && !mean)
        return spread->error_here(
            "direction_spread in degrees needs the mean direction: direction = 90; or write direction_spread = \"uniform\"");
    if (mean) out.mean = radians_per_degree * TRY(values.number(*mean, "direction", "deg", -360, 360));
    if (spread) out.spread = radians_per_degree * TRY(values.number(*spread, "direction_spread", "deg", 0, 360));
    return out;
}

}  // namespace corpuscle::skins
