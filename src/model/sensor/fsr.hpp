#pragma once

#include "model/sensor/front_end.hpp"

namespace corpuscle {

/// A force sensing resistor, Interlink's FSR 400, of conductance   G_FSR = 1/R_0 + F^m / a,   with F in gram-force (gf); 1/R_0 for F <= 0
/// (thesis eq. 13, with a correction of its errata: the resistance of the film alone is R_F = a F^-m with a = 170 kohm gf^m.) The curve was
/// fitted from 50 gf to 4 kgf; the press stimulus begins below that, at 20 gf. Hysteresis is a relative play operator, which is our choice:
/// the sensed force does not change while it is between F and (1 + hysteresis) F; otherwise it is the nearer end of that interval. So
/// falling force is read too high by up to the fraction `hysteresis`, and rising force correctly. Creep and drift are not modelled;
/// variation between sensors is set by --spread.
struct Fsr {
    static constexpr std::string_view name = "fsr", description = "force sensing resistor FSR 400: conductance of force";
    static constexpr std::string_view source = "thesis 4.1, eq. 13";
    static constexpr ParameterInfo parameters[] = {
        {"R_0", "ohm", 10e6, 1, 1e12, "resistance without force"},
        {"R_1gf", "ohm", 170e3, 1, 1e12, "resistance of the film alone at 1 gf (a in the formula, in ohm gf^m)",
         "thesis 4.1, printed 170 ohm gf; the data sheet's curve needs kilohms"},
        {"m", "", 0.72, 0.1, 2, "exponent of the film's conductance"},
        {"hysteresis", "", 0, 0, 1, "fraction by which falling force is read too high", "choice: none"},
    };

    static FrontEndStage stage(const ParameterValues<Fsr>& value) {
        return {.component = name,
                .output = {"G_FSR", "S"},
                .curve = [value](double F) { return conductance(value, F); },
                .hysteresis = value("hysteresis")};
    }

    /// The conductance in S at force F in N.
    static double conductance(const ParameterValues<Fsr>& value, double F) {
        constexpr double newtons_per_gf = 9.80665e-3,
                         smallest_gf = 1e-300;  // a smaller force may be denormal, which num::log() does not accept
        const double gf = F / newtons_per_gf;
        return 1 / value("R_0") + (gf > smallest_gf ? num::exp(value("m") * num::log(num::min(gf, 1e300))) / value("R_1gf") : 0);
    }
};

}  // namespace corpuscle
