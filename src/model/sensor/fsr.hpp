#pragma once

#include "core/number/elementary.hpp"
#include "core/parameter.hpp"
#include "model/sensor/front_end_stage.hpp"

namespace corpuscle {

/// A force sensing resistor, Interlink's FSR 400, of conductance   G_FSR = 1/R_0 + F^m / a,   with F in gram-force (gf); 1/R_0 for F <= 0
/// (thesis eq. 13, with a correction of its errata: the resistance of the film alone is R_F = a F^-m with a = 170 kohm gf^m.) The curve was
/// fitted from 50 gf to 4 kgf; the press stimulus begins below that, at 20 gf. Hysteresis is a relative play operator, which is our choice:
/// the sensed force does not change while it is between F and (1 + hysteresis) F; otherwise it is the nearer end of that interval. So
/// falling force is read too high by up to the fraction `hysteresis`, and rising force correctly. Creep and drift are not modelled;
/// variation between sensors is set by --spread.
struct Fsr {
    struct Params {
        double R_0 = 10e6, R_1gf = 170e3, m = 0.72, hysteresis = 0;
    };
    static constexpr std::string_view name = "fsr", description = "force sensing resistor FSR 400: conductance of force";
    static constexpr std::string_view source = "thesis 4.1, eq. 13";
    static constexpr ParameterDef<Params> fields[] = {
        {"R_0", &Params::R_0, "ohm", 1, 1e12, "resistance without force"},
        {"R_1gf", &Params::R_1gf, "ohm", 1, 1e12, "resistance of the film alone at 1 gf (a in the formula, in ohm gf^m)",
         "thesis 4.1, printed 170 ohm gf; the data sheet's curve needs kilohms"},
        {"m", &Params::m, "", 0.1, 2, "exponent of the film's conductance"},
        {"hysteresis", &Params::hysteresis, "", 0, 1, "fraction by which falling force is read too high", "choice: none"},
    };

    static FrontEndStage stage(const Params& p) {
        return {
            .component = name, .output = {"G_FSR", "S"}, .curve = [p](double F) { return conductance(p, F); }, .hysteresis = p.hysteresis};
    }

    /// The conductance in S at force F in N.
    static double conductance(const Params& p, double F) {
        constexpr double newtons_per_gf = 9.80665e-3,
                         smallest_gf = 1e-300;  // a smaller force may be denormal, which num::log() does not accept
        const double gf = F / newtons_per_gf;
        return 1 / p.R_0 + (gf > smallest_gf ? num::exp(p.m * num::log(num::min(gf, 1e300))) / p.R_1gf : 0);
    }
};

}  // namespace corpuscle
