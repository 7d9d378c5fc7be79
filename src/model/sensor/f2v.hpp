#pragma once

#include "model/sensor/front_end.hpp"

namespace corpuscle {

/// Force to voltage: a transimpedance amplifier that keeps V_FSR across the sensor, of conductance G_FSR.
///     V_Z = V_X + V_FSR G_FSR R_fb, but at most V_DD;   V_X = V_Y = V_SS + V_FSR
/// V_Z is the output, V_X the voltage at the sensor, V_Y the reference that V_X follows. (Thesis eq. 14, the last line of which omits the
/// conductance of the unloaded sensor, 1/R_0; see errata F5. It is part of G_FSR here.) The amplifier is ideal except for its supply.
struct F2v {
    static constexpr std::string_view name = "f2v", description = "force to voltage: transimpedance amplifier on a sensor's conductance";
    static constexpr std::string_view source = "thesis 4.2, fig. 20, eq. 14";
    static constexpr ParameterInfo parameters[] = {
        {"V_FSR", "V", 0.1, 1e-6, 100, "voltage across the sensor (V_Y - V_SS)", "inferred from the gain of thesis fig. 24b"},
        {"R_fb", "ohm", 10e3, 1e-3, 1e12, "feedback resistor (R_F in the thesis)", "choice: 0.55 V at 4 N"},
        {"V_SS", "V", 0, -100, 100, "lower supply", "thesis 4.2"},
        {"V_DD", "V", 0.7, -100, 100, "upper supply, where V_Z saturates", "thesis 4.2"},
    };
    static constexpr ParameterOrder order_constraints[] = {{"V_SS", "V_DD"}};

    static FrontEndStage stage(const ParameterValues<F2v>& value) {
        const double V_FSR = value("V_FSR"), R_fb = value("R_fb"), V_X = value("V_SS") + V_FSR;
        return {.component = name,
                .output = {"V_Z", "V"},
                .curve = [=](double G) { return V_X + V_FSR * G * R_fb; },
                .limit = value("V_DD"),
                .limit_name = "V_DD",
                .gain_name = "R_fb"};
    }
};

}  // namespace corpuscle
