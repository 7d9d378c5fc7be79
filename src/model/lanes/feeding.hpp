#pragma once
// How force is handed to a population of one precision: what is refused, and one profile for all of it.

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "model/lanes/buffer.hpp"
#include "model/lanes/profile.hpp"
#include "model/population.hpp"

namespace corpuscle::lanes {

/// Why a block of force does not fit `units` in V; `name`: what they are.
template <class V>
std::optional<Error> unfit_force(const PopulationForce& force, std::size_t steps, std::size_t units, std::string_view name) {
    if (const auto* columns = std::get_if<ForceColumns>(&force); columns && columns->of.size() != units)
        return bad_input(fmt::format("{}: {} columns of force for {} units", name, columns->of.size(), units));
    if (!std::is_same_v<V, double> && std::holds_alternative<ForceTiles<double>>(force))
        return bad_input(fmt::format("{}: tiles of double were handed to a population in float", name));
    if (!std::is_same_v<V, float> && std::holds_alternative<ForceTiles<float>>(force))
        return bad_input(fmt::format("{}: tiles of float were handed to a population in double", name));
    const auto* profile = std::get_if<ForceProfile>(&force);
    if (!profile) return {};
    if (profile->force.size() < steps)
        return bad_input(fmt::format("{}: a profile of {} samples for {} steps", name, profile->force.size(), steps));
    if (!profile->gain.empty() && profile->gain.size() != units)
        return bad_input(fmt::format("{}: {} gains for {} units", name, profile->gain.size(), units));
    for (const double g : profile->gain)
        if (!(g >= 0 && std::isfinite(g))) return bad_input(fmt::format("{}: a gain of {} is not in [0, inf)", name, g));
    return {};
}

/// The gains of a tile, whose first unit is `first`; 1 where none are given.
template <class V>
void profile_gains(const ForceProfile& profile, std::size_t first, V* out) {
    for (std::size_t u = 0; u < tile_units; ++u)
        out[u] = profile.gain.empty() ? V(1) : first + u < profile.gain.size() ? static_cast<V>(profile.gain[first + u]) : V(0);
}

/// The profile of a block, in V; or its currents, where they are worked out once.
template <class V>
class ProfileRows {
    std::array<ProfileCurrents, most_outputs> in_double_;
    std::array<std::array<Buffer<V>, 3>, most_outputs> currents_;  // from, to, both
    Buffer<V> force_;

    static void in_v(std::span<const double> values, Buffer<V>& out) {
        if (out.size() < values.size()) out = Buffer<V>(values.size());
        std::transform(values.begin(), values.end(), out.data(), [](double x) { return static_cast<V>(x); });
    }

public:
    void keep(std::span<const double> force) { in_v(force, force_); }
    void transduce(ProfileTransduction& by, std::span<const double> force, bool first, int outputs) {
        by.run(force, first, in_double_);
        for (std::size_t k = 0; k < static_cast<std::size_t>(outputs); ++k) {
            const auto& c = in_double_[k];
            in_v(c.from, currents_[k][0]), in_v(c.to, currents_[k][1]), in_v(c.both, currents_[k][2]);
        }
    }
    const V* force() const { return force_.data(); }
    const std::array<Buffer<V>, 3>& currents(int output) const { return currents_[static_cast<std::size_t>(output)]; }
};

}  // namespace corpuscle::lanes
