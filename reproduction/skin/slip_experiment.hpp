#pragma once
// A sphere that pulls the skin of the fingertip sideways and is then lifted: it slips at the edge of the contact first, then everywhere.

#include <string>
#include <vector>

#include "reproduction/skin/skin_touch.hpp"

namespace corpuscle {

inline constexpr double slip_force = 1, slip_radius = 8e-3, slip_E_star = 100e3;  // N, m, Pa
inline constexpr double slip_friction = 0.5, slip_pull = 1e-3;                    // m: the distance that the sphere moves sideways
inline constexpr double slip_lift = 0.5;                                          // s, in which the force falls to 0

/// The spikes of one class during the lift.
struct SlipResponse {
    std::string afferent;  ///< name of the class: "sa1"
    struct Part {
        double afferents = 0, spikes = 0;                  ///< with friction: number of afferents that fire, and of their spikes
        double afferents_without = 0, spikes_without = 0;  ///< the same touch without friction
        double only = 0;                                   ///< number of afferents that fire only with friction
    };
    Part partial, full;  ///< from the start of the lift until everything slips; from then on until the contact ends
};
/// Time (s) from the start of the lift until the complete contact slips, by Hertz, Cattaneo and Mindlin: until c = 0 in
/// c^2 = a^2 - 2 R s / (3 mu).
double time_to_full_slip();
/// Returns each class of the fingertip.
Result<std::vector<SlipResponse>> measure_slip(const std::shared_ptr<const Innervation>& fingertip);

}  // namespace corpuscle
