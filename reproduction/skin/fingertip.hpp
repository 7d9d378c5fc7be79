#pragma once
// The built-in fingertip pressed by a punch, for studies: spikes of each afferent.

#include <string>
#include <vector>

#include "core/force_source.hpp"

namespace corpuscle {

/// A flat, round, rigid punch on the fingertip, pressed as in section 1.2 of the thesis (stimulus `press`), but from `rest_force` to
/// `force`, which are normal forces.
struct Punch {
    double radius = 0, force = 0;  ///< m, N
    double rest_force = 0;         ///< N
    double tilt = 0, azimuth = 0;  ///< degrees: of the force from the normal, and of its direction along the skin from x
    Position shift = {};           ///< from the middle of the fingertip to the centre of the punch, m
};

/// The spikes of one afferent of the fingertip.
struct FingertipTrain {
    std::string afferent;        ///< afferent type: "sa1"
    double distance = 0;         ///< from the punch's centre to the afferent, m
    std::vector<double> spikes;  ///< s since the first sample of the force, without conduction delay
    double direction = 0;        ///< its preferred direction of shear, rad
};
/// Returns every afferent of the fingertip.
Result<std::vector<FingertipTrain>> simulate_fingertip(const Punch&);

}  // namespace corpuscle
