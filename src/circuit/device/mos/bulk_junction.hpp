#pragma once
// The junction between the bulk and the source or drain of a MOS transistor, as in SPICE.

namespace corpuscle::circuit {

/// One capacitance layer: capacitance at 0 V (F), potential (V) and grading coefficient. Above fc times the potential it is continued
/// linearly.
struct DepletionLayer {
    double c0 = 0, potential = 0.8, grading = 0.5, fc = 0.5;
};

struct JunctionValues {
    double i = 0, g = 0, q = 0, c = 0;  ///< A, S, C, F
};

/// Voltages are those of the p side above the n side, for the polarity of an NMOS: bulk above source or drain.
struct BulkJunction {
    double i_sat = 0;      ///< saturation current, A
    double n_vt = 0.0258;  ///< emission coefficient times kT/q, V
    DepletionLayer bottom, sidewall;

    ///     i = i_sat (exp(v / n_vt) - 1),  nearly constant below -3 n_vt as in SPICE;   q: integral of c0 / (1 - v / potential)^grading
    JunctionValues at(double v) const;
    /// The voltage at which the exponential bends most, V. Newton steps are limited above it.
    double critical_voltage() const;
};

/// Band gap of silicon, eV (Thurmond 1975, as SPICE has it).
double silicon_band_gap(double kelvin);
/// The part of the built-in potential that depends on the temperature only, V, as in SPICE: the potential at the temperature T is
/// T / 300.15 K times that at 300.15 K, plus this.
double potential_part(double kelvin);
/// Changes a layer from its values at the temperature `nominal` to those at `kelvin` (both K), after SPICE.
void adjust_layer(DepletionLayer&, double nominal, double kelvin);

/// The junction voltage (V) that a Newton step from `before` to v may reach, after Nagel's SPICE2.
double limited_junction_voltage(double v, double before, double n_vt, double critical);

}  // namespace corpuscle::circuit
