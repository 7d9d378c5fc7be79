#pragma once
// A front is a row of stages: what a sensor makes of force, and a transducer of that. Each part's file gives its stage.

#include <functional>
#include <limits>

#include "signal/afferent.hpp"

namespace corpuscle {

struct Stage {
    std::string_view part;                                   ///< "f2v"
    Probe shows;                                             ///< what leaves it
    std::function<double(double)> curve;                     ///< never falling; finite for every finite input
    double limit = std::numeric_limits<double>::infinity();  ///< the most that can leave it
    std::string_view limit_name = {};                        ///< the parameter that sets the limit
    std::string_view gain_name = {};                         ///< ... and the one to lower if it is too low
    double hysteresis = 0;                                   ///< of a sensor: see Front::played
};

}  // namespace corpuscle
