#include "circuit/device/junction.hpp"

#include "circuit/device/physical_constants.hpp"
#include "core/number/elementary.hpp"

namespace corpuscle::circuit {
namespace {

/// Band gap of silicon, eV (Thurmond 1975, as SPICE has it).
double band_gap(double kelvin) { return 1.16 - 7.02e-4 * kelvin * kelvin / (kelvin + 1108); }

}  // namespace

ValueSlope depletion_charge(double v, double c0, double vj, double m, double fc) {
    const double knee = fc * vj;
    if (c0 == 0) return {};
    const auto charge = [&](double u) { return c0 * vj * (1 - std::pow(1 - u / vj, 1 - m)) / (1 - m); };
    if (v < knee) return {charge(v), c0 * std::pow(1 - v / vj, -m)};
    const double f2 = std::pow(1 - fc, 1 + m), f3 = 1 - fc * (1 + m), slope = m / vj;
    return {charge(knee) + c0 / f2 * (f3 * (v - knee) + slope / 2 * (v * v - knee * knee)), c0 / f2 * (f3 + slope * v)};
}

void adjust_junction(double& capacitance, double& potential, double grading, double nominal, double kelvin) {
    constexpr double reference = 300.15;  // K
    const auto pb = [](double t) {        // temperature-dependent part of the built-in potential, V
        const double v = thermal_voltage(t);
        const double arg = -band_gap(t) / (2 * v) + 1.1150877 / (2 * thermal_voltage(reference));
        return -2 * v * (1.5 * num::log(t / reference) + arg);
    };
    const double base = (potential - pb(nominal)) / (nominal / reference);  // V: at the reference temperature
    const double nominal_part = 1 + grading * (4e-4 * (nominal - reference) - (potential - base) / base);
    const double adjusted = base * kelvin / reference + pb(kelvin);
    capacitance = capacitance / nominal_part * (1 + grading * (4e-4 * (kelvin - reference) - (adjusted - base) / base));
    potential = adjusted;
}

bool limit_junction(double& v, double v_before, double n_vt, double v_crit) {
    const double unlimited = v;
    if (v > v_crit && std::abs(v - v_before) > 2 * n_vt) {
        if (v_before > 0) {
            const double arg = 1 + (v - v_before) / n_vt;
            v = arg > 0 ? v_before + n_vt * std::log(arg) : v_crit;
        } else {
            v = n_vt * std::log(v / n_vt);
        }
    }
    return v != unlimited;
}

}  // namespace corpuscle::circuit
