#include "circuit/device/mos/bulk_junction.hpp"

#include <cmath>

#include "circuit/device/physical_constants.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double reference = 300.15;  // K

void add_layer(const DepletionLayer& l, double v, JunctionValues& out) {
    if (l.c0 == 0) return;
    const double knee = l.fc * l.potential, one_less = 1 - l.grading;
    const auto charge = [&](double u) { return l.c0 * l.potential * (1 - std::pow(1 - u / l.potential, one_less)) / one_less; };
    if (v < knee) {
        out.q += charge(v), out.c += l.c0 * std::pow(1 - v / l.potential, -l.grading);
        return;
    }
    const double at_knee = l.c0 * std::pow(1 - l.fc, -l.grading), slope = at_knee * l.grading / (l.potential * (1 - l.fc)), dv = v - knee;
    out.q += charge(knee) + dv * (at_knee + slope * dv / 2), out.c += at_knee + slope * dv;
}

}  // namespace

JunctionValues BulkJunction::at(double v) const {
    JunctionValues out;
    if (v >= -3 * n_vt) {
        const double e = std::exp(v / n_vt);
        out.i = i_sat * (e - 1), out.g = i_sat * e / n_vt;
    } else {
        const double arg = 3 * n_vt / (v * 2.718281828459045), cube = arg * arg * arg;
        out.i = -i_sat * (1 + cube), out.g = i_sat * 3 * cube / v;
    }
    add_layer(bottom, v, out), add_layer(sidewall, v, out);
    return out;
}

double BulkJunction::critical_voltage() const { return n_vt * std::log(n_vt / (std::sqrt(2.0) * std::fmax(i_sat, 1e-40))); }

double silicon_band_gap(double kelvin) { return 1.16 - 7.02e-4 * kelvin * kelvin / (kelvin + 1108); }

double potential_part(double kelvin) {
    const double v = thermal_voltage(kelvin);
    return -2 * v *
           (1.5 * std::log(kelvin / reference) - silicon_band_gap(kelvin) / (2 * v) + 1.1150877 / (2 * thermal_voltage(reference)));
}

void adjust_layer(DepletionLayer& l, double nominal, double kelvin) {
    const double base = (l.potential - potential_part(nominal)) / (nominal / reference);  // V: at 300.15 K
    const auto growth = [&](double t, double potential) { return 1 + l.grading * (4e-4 * (t - reference) - (potential - base) / base); };
    const double adjusted = base * kelvin / reference + potential_part(kelvin);
    l.c0 *= growth(kelvin, adjusted) / growth(nominal, l.potential);
    l.potential = adjusted;
}

double limited_junction_voltage(double v, double before, double n_vt, double critical) {
    if (v <= critical || std::abs(v - before) <= 2 * n_vt) return v;
    if (before <= 0) return n_vt * std::log(v / n_vt);
    const double arg = 1 + (v - before) / n_vt;
    return arg > 0 ? before + n_vt * std::log(arg) : critical;
}

}  // namespace corpuscle::circuit
