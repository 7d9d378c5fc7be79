#pragma once
// A number with its slopes over two voltages.

#include <cmath>

#include "circuit/device/junction.hpp"

namespace corpuscle::circuit {

/// A function of the voltages v_be and v_bc, with its derivatives.
struct Dual {
    double value = 0, by_be = 0, by_bc = 0;

    Dual() = default;
    Dual(double constant) : value(constant) {}  // implicit, so that formulas may contain constants
    Dual(double v, double be, double bc) : value(v), by_be(be), by_bc(bc) {}
    /// A function of one of the two voltages.
    static Dual of_be(ValueSlope f) { return {f.value, f.slope, 0}; }
    static Dual of_bc(ValueSlope f) { return {f.value, 0, f.slope}; }
    /// f(*this), where f has the derivative df here.
    Dual mapped(double f, double df) const { return {f, df * by_be, df * by_bc}; }

    friend Dual operator+(Dual a, Dual b) { return {a.value + b.value, a.by_be + b.by_be, a.by_bc + b.by_bc}; }
    friend Dual operator-(Dual a, Dual b) { return {a.value - b.value, a.by_be - b.by_be, a.by_bc - b.by_bc}; }
    friend Dual operator*(Dual a, Dual b) {
        return {a.value * b.value, a.by_be * b.value + a.value * b.by_be, a.by_bc * b.value + a.value * b.by_bc};
    }
    friend Dual operator/(Dual a, Dual b) {
        const double ratio = a.value / b.value;
        return {ratio, (a.by_be - ratio * b.by_be) / b.value, (a.by_bc - ratio * b.by_bc) / b.value};
    }
};

}  // namespace corpuscle::circuit
