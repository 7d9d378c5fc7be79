#pragma once
// A front end is a series of stages: a sensor, then a transducer. The file of each component defines its stage.

#include <functional>
#include <limits>

#include "signal/afferent.hpp"

namespace corpuscle {

struct FrontEndStage {
    std::string_view component;                              ///< "f2v"
    Probe output;                                            ///< its output
    std::function<double(double)> curve;                     ///< never decreasing; finite for every finite input
    double limit = std::numeric_limits<double>::infinity();  ///< upper limit of the output
    std::string_view limit_name = {};                        ///< the parameter that sets the limit
    std::string_view gain_name = {};                         ///< the parameter to lower if the limit is exceeded
    double hysteresis = 0;                                   ///< of a sensor: see FrontEnd::apply_hysteresis
};

}  // namespace corpuscle
