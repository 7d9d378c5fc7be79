// Random filters: they must agree with their closed forms or with .ac.

#include <fmt/format.h>

#include <numbers>

#include "circuit/random_kinds.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;
constexpr double max_error = 5e-3;  // V, for a swing of 1 V: fifty steps with errors of 1e-4 of the same sign

/// Returns a check that v(out) differs by at most `allowed` (V) from a closed form.
auto agrees_with(std::function<double(double)> exact, double allowed) {
    return [exact = std::move(exact), allowed](const TransientRunner& c, const TransientPoints& p) {
        const auto v = p.values(c.unknown("v(out)"));
        double worst = 0, when = 0;
        for (std::size_t k = 0; k < v.size(); ++k)
            if (const double error = std::abs(v[k] - exact(p.t[k])); error > worst) worst = error, when = p.t[k];
        return worst > allowed ? fmt::format("{:.3g} V from its closed form at {:.6g} s; at most {:.3g} V is allowed", worst, when, allowed)
                               : "";
    };
}

using Breakpoints = std::vector<std::pair<double, double>>;

/// Solution v(t) of tau dv/dt = u - v for a piecewise linear u that starts at (0, u0), with v(0) = u0.
double low_passed(const Breakpoints& breakpoints, double tau, double t) {
    double v = breakpoints.front().second;
    for (std::size_t k = 0; k < breakpoints.size() && breakpoints[k].first < t; ++k) {
        const auto [t0, u0] = breakpoints[k];
        const bool last = k + 1 == breakpoints.size();
        const double slope = last ? 0 : (breakpoints[k + 1].second - u0) / (breakpoints[k + 1].first - t0);
        const double elapsed = std::min(t, last ? t : breakpoints[k + 1].first) - t0;
        v = u0 + slope * (elapsed - tau) + (v - u0 + slope * tau) * std::exp(-elapsed / tau);
    }
    return v;
}

/// A first-order filter from `in` to `out`; sets tau to its time constant (s).
std::string first_order(RandomSource& dice, double& tau) {
    if (dice.index_below(3) > 0) {
        const double R = 1 / dice.log_uniform(1e-15, 1e-3), C = dice.log_uniform(1e-15, 1e-3);
        tau = R * C;
        return fmt::format("r1 in out {:.9g}\nc1 out 0 {:.9g}\n", R, C);
    }
    const double R = 1 / dice.log_uniform(1e-11, 1e-3);  // 1e-11: lower limit of an inductor's current, A
    tau = dice.log_uniform(1e-9, 1e3);
    return fmt::format("l1 in out {:.9g}\nr1 out 0 {:.9g}\n", R * tau, R);
}

/// Complex amplitude at frequency f (Hz) in the last two periods, by a least-squares fit of mean, fundamental and second harmonic.
std::complex<double> swing(const TransientPoints& p, int unknown, double f) {
    constexpr int count = 5;
    double A[count][count + 1] = {};
    const double from = p.t.back() - 2 / f;
    for (std::size_t k = 1; k < p.t.size(); ++k) {
        if (p.t[k] < from) continue;
        const double a = full_turn * f * p.t[k], w = p.t[k] - p.t[k - 1];
        const double row[count + 1] = {
            1, std::sin(a), std::cos(a), std::sin(2 * a), std::cos(2 * a), p.x[k][static_cast<std::size_t>(unknown)]};
        for (int i = 0; i < count; ++i)
            for (int j = 0; j <= count; ++j) A[i][j] += w * row[i] * row[j];
    }
    for (int i = 0; i < count; ++i)
        for (int below = 0; below < count; ++below) {
            if (below == i) continue;
            const double factor = A[below][i] / A[i][i];
            for (int j = 0; j <= count; ++j) A[below][j] -= factor * A[i][j];
        }
    return {A[1][count] / A[1][1], A[2][count] / A[2][2]};
}

}  // namespace

RandomCircuit make_first_order(RandomSource& dice) {
    RandomCircuit out;
    double tau = 0;
    const auto elements = first_order(dice, tau);
    Breakpoints breakpoints = {{0, 0}};
    std::string waveform;
    if (dice.index_below(2) == 0) {
        const double delay = dice.uniform_between(0.1, 1) * tau, rise = tau * dice.log_uniform(1e-4, 1),
                     width = dice.uniform_between(0.5, 3) * tau;
        const double pause = dice.uniform_between(0.5, 3) * tau, period = 2 * rise + width + pause;
        waveform = fmt::format("pulse(0 1 {:.9g} {:.9g} {:.9g} {:.9g} {:.9g})", delay, rise, rise, width, period);
        for (int round = 0; round < 3; ++round) {
            const double at = delay + round * period;
            breakpoints.insert(breakpoints.end(), {{at, 0}, {at + rise, 1}, {at + rise + width, 1}, {at + 2 * rise + width, 0}});
        }
        breakpoints.emplace_back(delay + 3 * period, 0);
    } else {
        waveform = "pwl(0 0";
        for (int k = 0; k < 6; ++k) {
            breakpoints.emplace_back(breakpoints.back().first + tau * dice.log_uniform(1e-3, 3), dice.uniform_between(-1, 1));
            waveform += fmt::format(" {:.12g} {:.9g}", breakpoints.back().first, breakpoints.back().second);
        }
        waveform += ")";
    }
    const double stop = breakpoints.back().first;
    out.text = fmt::format("first order, tau {:.3g} s\nv1 in 0 {}\n{}.tran {:.6g} {:.9g}\n", tau, waveform, elements, tau / 1000, stop);
    out.min_voltage = -1.001, out.max_voltage = 1.001;
    out.find_fault = agrees_with([=](double t) { return low_passed(breakpoints, tau, t); }, max_error);
    return out;
}

RandomCircuit make_sine_first_order(RandomSource& dice) {
    RandomCircuit out;
    double tau = 0;
    const auto elements = first_order(dice, tau);
    const double f = dice.log_uniform(0.1, 10) / (full_turn * tau), w = full_turn * f, x = w * tau, lag = std::atan(x);
    out.text = fmt::format("first order under a sine, tau {:.3g} s\nv1 in 0 sin(0 1 {:.12g})\n{}.tran {:.6g} {:.9g}\n", tau, f, elements,
                           0.001 / f, 5 / f);
    out.min_voltage = -1.01, out.max_voltage = 1.01;
    out.find_fault =
        agrees_with([=](double t) { return (std::sin(w * t - lag) + std::sin(lag) * std::exp(-t / tau)) / std::hypot(1.0, x); }, max_error);
    return out;
}

RandomCircuit make_tank(RandomSource& dice) {
    const double R = 1 / dice.log_uniform(1e-15, 1e-3), C = dice.log_uniform(1e-15, 1e-3), Q = dice.log_uniform(0.7, 30);
    const double natural = Q / (R * C), alpha = 1 / (2 * R * C), omega = std::sqrt(natural * natural - alpha * alpha);
    RandomCircuit out;
    out.text = fmt::format("tank, {:.3g} F and Q = {:.3g}\nl1 out 0 {:.9g}\nc1 out 0 {:.9g}\nr1 out 0 {:.9g}\n.ic v(out)=1\n", C, Q,
                           1 / (natural * natural * C), C, R) +
               fmt::format(".tran {:.6g} {:.9g} uic\n", 0.01 / omega, 5 * full_turn / omega);
    out.min_voltage = -1.01, out.max_voltage = 1.01;
    out.find_fault = agrees_with(
        [=](double t) { return std::exp(-alpha * t) * (std::cos(omega * t) - alpha / omega * std::sin(omega * t)); }, 4 * max_error);
    return out;
}

/// A differential pair as a follower that drives a capacitor; its input is a sine of 5 mV. Compared with .ac.
RandomCircuit make_gm_c(RandomSource& dice) {
    const double I = dice.log_uniform(1e-15, 1e-3), k = std::max(1.0, std::round(I / 100e-9)),
                 C = dice.log_uniform(std::max(1e-15, k * 1e-15), 1e-3);
    const double corner = I / (2 * 0.033) / (full_turn * (C + k * 100e-15)), f = corner * dice.log_uniform(0.1, 3);
    const double stop = std::ceil(f / corner) / f + 4 / f;
    RandomCircuit out;
    const auto p = [&](int stack) { return fmt::format(" pch w=6u l=0.5u m={:.0f} stack={}\n", 2 * k, stack); };
    const auto n = [&](int stack) { return fmt::format(" nch w=1.5u l=0.5u m={:.0f} stack={}\n", 2 * k, stack); };
    out.text = fmt::format("gm-C follower, {:.3g} A and {:.3g} F\n.lib 'tsmc180.lib' tt\nvdd vdd 0 0.7\nib vdd gb {:.6g}\n", I, C, I) +
               fmt::format("vin in 0 dc 0.45 ac 1 sin(0.45 5m {:.9g})\n", f) + "mb gb gb 0 0" + n(4) + "mt t gb 0 0" + n(4) +
               "m1 x in t 0" + n(1) + "m2 out out t 0" + n(1) + "m3 x x vdd vdd" + p(1) + "m4 out x vdd vdd" + p(1) +
               fmt::format("co out 0 {:.6g}\n", C) + fmt::format(".ac lin 1 {:.9g} {:.9g}\n.tran {:.6g} {:.9g}\n", f, f, 0.001 / f, stop);
    out.plan.reltol = 1e-5, out.plan.vntol = 1e-7;
    out.min_voltage = -0.1, out.max_voltage = 0.8;
    out.find_fault = [f](const TransientRunner& c, const TransientPoints& run) -> std::string {
        const auto expected = c.first_ac_value("v(out)");
        const auto s = swing(run, c.unknown("v(out)"), f) / 5e-3;
        if (std::abs(s - expected) < 0.02 * std::abs(expected) + 1e-3) return "";
        return fmt::format("the gain is {:.4f} {:+.4f}i, but .ac gives {:.4f} {:+.4f}i", s.real(), s.imag(), expected.real(),
                           expected.imag());
    };
    return out;
}

RandomCircuit make_rectifier(RandomSource& dice) {
    const double I = dice.log_uniform(1e-15, 1e-3), C = dice.log_uniform(1e-15, 1e-3), f = I / C * dice.log_uniform(0.1, 100);
    RandomCircuit out;
    out.text = fmt::format("rectifier, {:.3g} A and {:.3g} F\n.model d1 d(is={:.3g} n={:.3g} cjo={:.3g})\n", I, C,
                           I * dice.log_uniform(1e-9, 1e-3), dice.uniform_between(1, 2), C * dice.log_uniform(1e-6, 1e-2)) +
               fmt::format("v1 in 0 sin(0 1 {:.9g})\ndx in out d1\nc1 out 0 {:.9g}\nr1 out 0 {:.9g}\n.tran {:.6g} {:.9g}\n", f, C, 1 / I,
                           0.001 / f, 10 / f);
    out.min_voltage = -1.01, out.max_voltage = 1.01;
    out.find_fault = [](const TransientRunner& c, const TransientPoints& p) -> std::string {
        IdaOptions options;
        options.output_times = p.t, options.reltol = options.vntol = 1e-7;
        const auto reference = c.run_ida(options);
        if (!reference.error.empty()) return "IDA: " + reference.error;
        const auto v = static_cast<std::size_t>(c.unknown("v(out)"));
        double worst = 0, when = 0;
        for (std::size_t k = 1; k < p.t.size() && k < reference.x.size(); ++k)
            if (const double error = std::abs(p.x[k][v] - reference.x[k][v]); error > worst) worst = error, when = p.t[k];
        return worst > max_error
                   ? fmt::format("{:.3g} V from IDA's result at {:.6g} s; at most {:.3g} V is allowed", worst, when, max_error)
                   : "";
    };
    return out;
}

}  // namespace corpuscle::circuit
