#pragma once
// The force into a population whose number type is V: its checks, and the buffers for a profile, which is one force for all afferents.

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "model/lane_population.hpp"
#include "model/lanes/aligned_buffer.hpp"
#include "model/lanes/kernel.hpp"

namespace corpuscle::lanes {

/// Returns an error if a block of force does not fit `size` afferents of precision V with this number of forces each. `name` is the
/// population's name for messages.
template <class V>
Result<void> check_force(const PopulationForce& force, std::size_t steps, std::size_t size, std::size_t forces, std::string_view name) {
    if (const auto* columns = std::get_if<ForceColumns>(&force); columns && columns->columns.size() != size * forces)
        return bad_input(fmt::format("{}: {} columns of force for {} afferents{}", name, columns->columns.size(), size,
                                     forces > 1 ? fmt::format(" with {} forces each", forces) : ""));
    if (forces > 1 && std::holds_alternative<ForceProfile>(force))
        return bad_input(fmt::format("{}: afferents with {} forces each cannot have a profile; give columns or tiles", name, forces));
    if (!std::is_same_v<V, double> && std::holds_alternative<ForceTiles<double>>(force))
        return bad_input(fmt::format("{}: a population in float needs tiles of float, not double", name));
    if (!std::is_same_v<V, float> && std::holds_alternative<ForceTiles<float>>(force))
        return bad_input(fmt::format("{}: a population in double needs tiles of double, not float", name));
    const auto* profile = std::get_if<ForceProfile>(&force);
    if (!profile) return {};
    if (profile->force.size() < steps)
        return bad_input(fmt::format("{}: a profile of {} samples for {} steps", name, profile->force.size(), steps));
    if (!profile->gain.empty() && profile->gain.size() != size)
        return bad_input(fmt::format("{}: {} gains for {} afferents", name, profile->gain.size(), size));
    for (const double g : profile->gain)
        if (!(g >= 0 && std::isfinite(g))) return bad_input(fmt::format("{}: a gain of {} is not in [0, inf)", name, g));
    return {};
}

/// Writes the gains of the tile whose first afferent is `first` to out[tile_size]. If the profile has no gains, they are 1, otherwise those
/// of padding are 0.
template <class V>
void profile_gains(const ForceProfile& profile, std::size_t first, V* out) {
    for (std::size_t u = 0; u < tile_size; ++u)
        out[u] = profile.gain.empty() ? V(1) : first + u < profile.gain.size() ? static_cast<V>(profile.gain[first + u]) : V(0);
}

/// For each step the current at its beginning and at its end, and their sum: of one output under a profile, A.
using ProfileCurrents = std::array<std::vector<double>, 3>;

/// If many afferents share one force and one set of receptor parameters, the current of their receptor is computed once: that of all
/// afferents, apart from a gain, in double precision.
class SharedReceptor {
public:
    virtual ~SharedReceptor() = default;
    virtual std::vector<double> save() const = 0;
    virtual bool resume(std::span<const double>) = 0;  ///< returns false if the values are not a state of this receptor
    /// Simulates the next steps, one for each sample of force (N). `first`: true for the first block of a simulation.
    virtual void run(std::span<const double> force, bool first, std::array<ProfileCurrents, max_outputs>& out) = 0;
};

/// The force of a profile, or the currents that it causes in the shared receptor, converted to V.
template <class V>
class ProfileBuffers {
    std::array<ProfileCurrents, max_outputs> in_double_;                 // the currents before conversion
    std::array<std::array<AlignedBuffer<V>, 3>, max_outputs> currents_;  // of each output, as ProfileCurrents
    AlignedBuffer<V> force_;

    static void convert(std::span<const double> values, AlignedBuffer<V>& out) {
        if (out.size() < values.size()) out = AlignedBuffer<V>(values.size());
        std::transform(values.begin(), values.end(), out.data(), [](double x) { return static_cast<V>(x); });
    }

public:
    void set_force(std::span<const double> force) { convert(force, force_); }
    /// `first`: true for the first block of a simulation; `outputs`: number of currents of the receptor.
    void compute_currents(SharedReceptor& receptor, std::span<const double> force, bool first, int outputs) {
        receptor.run(force, first, in_double_);
        for (std::size_t k = 0; k < static_cast<std::size_t>(outputs); ++k)
            for (std::size_t part = 0; part < 3; ++part) convert(in_double_[k][part], currents_[k][part]);
    }
    const V* force() const { return force_.data(); }
    const std::array<AlignedBuffer<V>, 3>& currents(int output) const { return currents_[static_cast<std::size_t>(output)]; }
};

}  // namespace corpuscle::lanes
