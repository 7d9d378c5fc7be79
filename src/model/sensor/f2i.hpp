#pragma once

#include "core/parameter.hpp"
#include "model/sensor/front_end_stage.hpp"

namespace corpuscle {

/// Force to current. The voltage V_FSR across the sensor, of conductance G_FSR, drives a current, of which two transistor arrays with a
/// common gate split off a fraction:
///     I_F = V_FSR G_FSR S_1 / (S_1 + S_2), limited to I_max
/// (thesis eq. 15, fig. 22, with a correction of its errata: the smaller array carries S_1/(S_1 + S_2) of the split current, here 1/17.)
/// V_FSR is V_Y - V_SS: V_Y is the reference that the amplifier's input follows, V_SS the lower supply.
struct F2i {
    struct Params {
        double V_FSR = 0.1, S_1 = 1, S_2 = 16, I_max = 5e-6;
    };
    static constexpr std::string_view name = "f2i", description = "force to current: a fraction of the sensor's current";
    static constexpr std::string_view source = "thesis 4.2, figs. 21 and 22, eq. 15, table 1";
    static constexpr ParameterDef<Params> fields[] = {
        {"V_FSR", &Params::V_FSR, "V", 1e-6, 100, "voltage across the sensor (V_Y - V_SS)", "inferred from the gain of thesis fig. 24b"},
        {"S_1", &Params::S_1, "", 1e-6, 1e6, "aspect ratio W/L of the array that carries I_F"},
        {"S_2", &Params::S_2, "", 0, 1e6, "aspect ratio W/L of the array that carries the rest; 0: I_F is the whole current"},
        {"I_max", &Params::I_max, "A", 1e-15, 1e3, "largest current I_F of the amplifier", "choice: reached at about 10 N"},
    };

    static FrontEndStage stage(const Params& p) {
        return {.component = name,
                .output = {"I_F", "A"},
                .curve = [p](double G) { return p.V_FSR * G * (p.S_1 / (p.S_1 + p.S_2)); },
                .limit = p.I_max,
                .limit_name = "I_max",
                .gain_name = "V_FSR"};
    }
};

}  // namespace corpuscle
