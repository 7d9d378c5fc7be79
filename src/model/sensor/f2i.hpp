#pragma once

#include "model/sensor/front_end.hpp"

namespace corpuscle {

/// Force to current. The voltage V_FSR across the sensor, of conductance G_FSR, drives a current, of which two transistor arrays with a
/// common gate split off a fraction:
///     I_F = V_FSR G_FSR S_1 / (S_1 + S_2), limited to I_max
/// (thesis eq. 15, fig. 22, with a correction of its errata: the smaller array carries S_1/(S_1 + S_2) of the split current, here 1/17.)
/// V_FSR is V_Y - V_SS: V_Y is the reference that the amplifier's input follows, V_SS the lower supply.
struct F2i {
    static constexpr std::string_view name = "f2i", description = "force to current: a fraction of the sensor's current";
    static constexpr std::string_view source = "thesis 4.2, figs. 21 and 22, eq. 15, table 1";
    static constexpr ParameterInfo parameters[] = {
        {"V_FSR", "V", 0.1, 1e-6, 100, "voltage across the sensor (V_Y - V_SS)", "inferred from the gain of thesis fig. 24b"},
        {"S_1", "", 1, 1e-6, 1e6, "aspect ratio W/L of the array that carries I_F"},
        {"S_2", "", 16, 0, 1e6, "aspect ratio W/L of the array that carries the rest; 0: I_F is the whole current"},
        {"I_max", "A", 5e-6, 1e-15, 1e3, "largest current I_F of the amplifier", "choice: reached at about 10 N"},
    };

    static FrontEndStage stage(const ParameterValues<F2i>& value) {
        const double V_FSR = value("V_FSR"), fraction = value("S_1") / (value("S_1") + value("S_2"));
        return {.component = name,
                .output = {"I_F", "A"},
                .curve = [=](double G) { return V_FSR * G * fraction; },
                .limit = value("I_max"),
                .limit_name = "I_max",
                .gain_name = "V_FSR"};
    }
};

}  // namespace corpuscle
