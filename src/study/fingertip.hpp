#pragma once
// The built-in fingertip pressed by a punch, for studies: what each of its afferents fires.

#include <string>
#include <vector>

#include "signal/source.hpp"

namespace corpuscle {

/// A flat, round, rigid punch on the middle of the fingertip, pressed as in the thesis (1.2) from no force to `force`.
struct Punch {
    double radius = 0, force = 0;  ///< m, N
};

/// One afferent's spikes, s, without conduction.
struct TipTrain {
    std::string of;   ///< "sa1"
    double from = 0;  ///< the punch's middle to the afferent's, m
    std::vector<double> spikes;
};
Result<std::vector<TipTrain>> fingertip_under(const Punch&);

}  // namespace corpuscle
