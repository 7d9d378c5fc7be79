// Random oscillators: they must oscillate with a constant period.

#include <fmt/format.h>

#include "circuit/random_kinds.hpp"

namespace corpuscle::circuit {
namespace {

/// Fault of an oscillation, or empty: the intervals after the first must agree within 0.5 %. If `must_swing`, at least three are required.
std::string period_fault(const TransientRunner& circuit, const TransientPoints& points, const std::string& node, double level,
                         bool must_swing) {
    const auto rises = circuit.spike_times(points, node, level);
    if (rises.size() < 5) return must_swing ? fmt::format("{} rises {} times; at least 5 are required", node, rises.size()) : "";
    double shortest = 1e300, longest = 0;
    for (std::size_t k = 2; k < rises.size(); ++k) {
        shortest = std::min(shortest, rises[k] - rises[k - 1]);
        longest = std::max(longest, rises[k] - rises[k - 1]);
    }
    return longest > 1.005 * shortest ? fmt::format("intervals from {:.6g} to {:.6g} s", shortest, longest) : "";
}

}  // namespace

/// The circuit of oscillator.hpp, with all transistors wider in proportion to the current.
RandomCircuit make_relaxation(RandomSource& dice) {
    const double I = dice.log_uniform(1e-15, 1e-3), k = std::max(1.0, std::round(I / 10e-9));
    const double low = std::max(0.1e-12 * k, 20e-6 * I / 0.27), high = std::min(1e-3, 1e6 * I / 0.27);
    const double C = dice.log_uniform(std::min(low, 1e-3), std::max(high, low)), T = 0.26 * (C + 0.35e-12 * k) / I;
    RandomCircuit out;
    const auto p = [&](int m, int stack) { return fmt::format(" pch w=6u l=0.5u m={:.0f} stack={}\n", m * k, stack); };
    const auto n = [&](int m, int stack) { return fmt::format(" nch w=1.5u l=0.5u m={:.0f} stack={}\n", m * k, stack); };
    out.text = fmt::format("relaxation oscillator of transistors, {:.3g} A and {:.3g} F\n.lib 'tsmc180.lib' tt\nvdd vdd 0 0.7\n", I, C) +
               fmt::format("cu u 0 {:.6g}\niin u 0 {:.6g}\nich gc 0 {:.6g}\n", C, I, 50 * I) + "m1 gc gc vdd vdd" + p(2, 4) +
               "m2 y gc vdd vdd" + p(2, 4) + "m3 u sb y vdd" + p(2, 1) + "m4 mp u vdd vdd" + p(2, 4) + "m5 s u mp vdd" + p(16, 1) +
               "m6 0 s mp vdd" + p(8, 1) + "m7 mn u 0 0" + n(2, 4) + "m8 s u mn 0" + n(16, 1) + "m9 vdd s mn 0" + n(8, 1) +
               "m10 sb s vdd vdd" + p(2, 1) + "m11 sb s 0 0" + n(2, 1) +
               fmt::format(".ic v(u)=0.6\n.tran {:.6g} {:.6g}\n", T / 1000, 8 * T);
    out.min_voltage = -0.3, out.max_voltage = 1.0;
    // at a few picoamperes, leakage into the membrane can prevent the oscillation
    out.find_fault = [must_swing = I >= 20e-12](const TransientRunner& c, const TransientPoints& run) {
        return period_fault(c, run, "v(s)", 0.35, must_swing);
    };
    return out;
}

/// C du/dt = I (2 s - 1). s follows a function of s and u with hysteresis, with a time constant of at most a hundredth of the period.
RandomCircuit make_ideal_relaxation(RandomSource& dice) {
    const double I = dice.log_uniform(1e-15, 1e-3), C = dice.log_uniform(1e-15, 1e-3), T = C / I;
    const double switching_time = T * dice.log_uniform(1e-6, 1e-2);
    RandomCircuit out;
    out.text = fmt::format("ideal relaxation oscillator, {:.3g} A and {:.3g} F\n", I, C) +
               fmt::format("cu u 0 {:.6g}\nru u 0 {:.6g}\nbu 0 u i='{:.6g}*(2*v(s)-1)'\n", C, 1e3 / I, I) +
               "bs s0 0 v='0.5+0.5*tanh(10*(v(s)-0.5-2*(v(u)-0.5)))'\n" +
               fmt::format("rs s0 s {:.6g}\ncs s 0 {:.6g}\n.ic v(u)=0.5 v(s)=1\n.tran {:.6g} {:.6g}\n", 1 / I, switching_time * I, T / 1000,
                           10 * T);
    out.min_voltage = -0.3, out.max_voltage = 1.3;
    out.find_fault = [](const TransientRunner& c, const TransientPoints& p) { return period_fault(c, p, "v(s)", 0.5, true); };
    return out;
}

RandomCircuit make_ring(RandomSource& dice) {
    const int stages = 3 + 2 * dice.index_below(4);
    const double m = std::round(dice.log_uniform(1, 1000)), C = dice.log_uniform(1e-15, 1e-3), vdd = dice.uniform_between(0.4, 0.9);
    // measured: 76 ns per stage at 0.7 V for one element with a picofarad, and factors for supplies of 0.4 V to 0.9 V
    static constexpr double period_factor[] = {37.8, 5.84, 1.97, 1, 0.62, 0.44};
    const auto at = std::min(4, static_cast<int>((vdd - 0.4) / 0.1));
    const double T =
        stages * 76e3 * (C / m + 35e-15) * period_factor[at] * std::pow(period_factor[at + 1] / period_factor[at], (vdd - 0.4) / 0.1 - at);
    RandomCircuit out;
    out.text = fmt::format("ring of {} inverters, {:.3g} F each\n.lib 'tsmc180.lib' tt\nvdd vdd 0 {:.4g}\n", stages, C, vdd);
    for (int k = 0; k < stages; ++k)
        out.text += fmt::format(
            "mp{0} n{1} n{0} vdd vdd pch w=6u l=0.5u m={2:.0f}\nmn{0} n{1} n{0} 0 0 nch w=1.5u l=0.5u m={2:.0f}\nc{0}x n{1} 0 {3:.6g}\n", k,
            (k + 1) % stages, m, C);
    out.text += fmt::format(".ic v(n0)=0\n.tran {:.6g} {:.6g}\n", T / 1000, 8 * T);
    out.min_voltage = -0.5, out.max_voltage = vdd + 0.5;
    out.find_fault = [vdd](const TransientRunner& c, const TransientPoints& p) { return period_fault(c, p, "v(n0)", vdd / 2, true); };
    return out;
}

/// Three stages C dv/dt = -I (tanh(g v_before) + v), where v_before is the output of the stage before.
RandomCircuit make_ideal_ring(RandomSource& dice) {
    const double I = dice.log_uniform(1e-15, 1e-3), C = dice.log_uniform(1e-15, 1e-3), gain = dice.log_uniform(3, 100), T = 3.6 * C / I;
    RandomCircuit out;
    out.text = fmt::format("ideal ring, {:.3g} A and {:.3g} F\n", I, C);
    for (const auto* pair : {"ca", "ab", "bc"})
        out.text += fmt::format("b{1} {1} 0 i='{2:.6g}*tanh({3:.6g}*v({0}))'\nr{1}r {1} 0 {4:.6g}\nc{1}c {1} 0 {5:.6g}\n", pair[0], pair[1],
                                I, gain, 1 / I, C);
    out.text += fmt::format(".ic v(a)=0.5 v(b)=-0.5 v(c)=0\n.tran {:.6g} {:.6g}\n", T / 1000, 12 * T);
    out.min_voltage = -1.01, out.max_voltage = 1.01;
    // skips the initial growth or decay of the amplitude
    out.find_fault = [](const TransientRunner& c, const TransientPoints& p) {
        TransientPoints late;
        for (std::size_t k = 0; k < p.t.size(); ++k)
            if (p.t[k] > 0.5 * p.t.back()) late.t.push_back(p.t[k]), late.x.push_back(p.x[k]);
        return period_fault(c, late, "v(a)", 0, true);
    };
    return out;
}

}  // namespace corpuscle::circuit
