#pragma once
// The built-in fingertip pressed by a punch, for studies: spikes of each afferent.

#include <string>
#include <vector>

#include "core/force_source.hpp"

namespace corpuscle {

/// A flat, round, rigid punch on the middle of the fingertip, pressed as in section 1.2 of the thesis (stimulus `press`),
/// but from zero force to `force`.
struct Punch {
    double radius = 0, force = 0;  ///< m, N
};

/// The spikes of one afferent of the fingertip.
struct FingertipTrain {
    std::string afferent;        ///< afferent type: "sa1"
    double distance = 0;         ///< from the punch's centre to the afferent, m
    std::vector<double> spikes;  ///< s since the first sample of the force, without conduction delay
};
/// Returns every afferent of the fingertip.
Result<std::vector<FingertipTrain>> simulate_fingertip(const Punch&);

}  // namespace corpuscle
