#pragma once
// The junction of diodes and bipolar transistors: its current, its charge, their dependence on temperature, and the limit of a Newton step.

#include <cmath>

namespace corpuscle::circuit {

/// A current (A) and its conductance (S), or a charge (C) and its capacitance (F).
struct ValueSlope {
    double value = 0, slope = 0;
};

/// i = is (exp(v / n_vt) - 1), nearly constant below -3 n_vt as in SPICE. v: V; is: A; n_vt: n kT/q, V.
inline ValueSlope junction_current(double v, double is, double n_vt) {
    if (v >= -3 * n_vt) {
        const double e = std::exp(v / n_vt);
        return {is * (e - 1), is * e / n_vt};
    }
    const double arg = 3 * n_vt / (v * 2.718281828459045), cube = arg * arg * arg;
    return {-is * (1 + cube), is * 3 * cube / v};
}

/// Charge of a depletion layer at the junction voltage v (V): the integral of c0 / (1 - v/vj)^m, continued as a parabola above fc vj.
/// c0: capacitance at 0 V, F; vj: potential, V; m: grading coefficient.
ValueSlope depletion_charge(double v, double c0, double vj, double m, double fc);

/// Changes the capacitance at 0 V and the potential of a junction to their values at another temperature, after SPICE. nominal: K.
void adjust_junction(double& capacitance, double& potential, double grading, double nominal, double kelvin);

/// Limits a Newton step that ends at the junction voltage v (V), after Nagel's SPICE2. A large forward step is shortened to the voltage at
/// which the exponential reaches the current that the linearization predicts. v_before: voltage of the last evaluation; n_vt: n kT/q;
/// v_crit: see critical_voltage() (all in V). Returns true if the step was shortened.
bool limit_junction(double& v, double v_before, double n_vt, double v_crit);

/// The voltage (V) at which the curve of the current over the voltage bends most. is: A; n_vt: V.
inline double critical_voltage(double is, double n_vt) { return n_vt * std::log(n_vt / (1.4142135623730951 * is)); }

}  // namespace corpuscle::circuit
