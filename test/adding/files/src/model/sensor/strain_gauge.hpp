#pragma once

#include "core/parameter.hpp"
#include "model/sensor/front_end_stage.hpp"

namespace corpuscle {

/// A sensor whose conductance is proportional to the force.
struct StrainGauge {
    struct Params {
        double gain = 1e-6;
    };
    static constexpr std::string_view name = "gauge", description = "conductance proportional to the force", source = "choice";
    static constexpr ParameterDef<Params> fields[] = {{"gain", &Params::gain, "S/N", 1e-15, 1, "conductance per force"}};

    static FrontEndStage stage(const Params& p) {
        return {.component = name, .output = {"G", "S"}, .curve = [p](double F) { return p.gain * F; }};
    }
};

}  // namespace corpuscle
