#pragma once
// The thesis's force sensor (4.1): eq. 13.

#include <cmath>

namespace corpuscle {

constexpr double gram_force = 9.80665e-3;  // N

/// Eq. 13 corrected (errata F1): conductance G = 1/R_0 + F^m / a, with the force F in gf, the resistance R_0 without force, and a = 170
/// kohm gf^m.
struct ForceSensor {
    double R_0 = 10e6, a = 170e3, m = 0.72;                                        ///< ohm, ohm gf^m, exponent
    double conductance(double gf) const { return 1 / R_0 + std::pow(gf, m) / a; }  ///< S
    double slope(double gf) const { return m * std::pow(gf, m - 1) / a; }          ///< dG/dF, S/gf
};

}  // namespace corpuscle
