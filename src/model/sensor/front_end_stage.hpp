#pragma once
// One stage of a front end: the sensor, or the transducer after it. The file of each component defines its stage.

#include <functional>
#include <limits>

#include "core/afferent.hpp"
#include "model/parameter_values.hpp"

namespace corpuscle {

struct FrontEndStage {
    std::string_view component;  ///< name of the component: "f2v"
    Probe output;                ///< name and unit of its output
    /// The output for an input, which is the force (N) or the output of the stage before. It never decreases, and is finite for finite
    /// input.
    std::function<double(double)> curve;
    double limit = std::numeric_limits<double>::infinity();  ///< upper limit of the output, in its unit
    std::string_view limit_name = {};                        ///< the parameter that sets the limit
    std::string_view gain_name = {};                         ///< the parameter that messages advise to lower if the limit is exceeded
    double hysteresis = 0;                                   ///< of a sensor, a fraction: see FrontEnd::apply_hysteresis
};

}  // namespace corpuscle
