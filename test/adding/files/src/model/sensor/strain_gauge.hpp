#pragma once

#include "model/sensor/front_end.hpp"

namespace corpuscle {

/// A sensor whose conductance is proportional to the force.
struct StrainGauge {
    static constexpr std::string_view name = "gauge", description = "conductance proportional to the force", source = "choice";
    static constexpr ParameterInfo parameters[] = {{"gain", "S/N", 1e-6, 1e-15, 1, "conductance per force"}};

    static FrontEndStage stage(const ParameterValues<StrainGauge>& value) {
        return {.component = name, .output = {"G", "S"}, .curve = [gain = value("gain")](double F) { return gain * F; }};
    }
};

}  // namespace corpuscle
