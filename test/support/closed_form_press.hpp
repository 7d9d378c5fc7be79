#pragma once
// Reference spike times of the thesis's two afferents (SA-I and FA-I) under its press, independent of any sampling rate. The high-passed
// force is a closed formula; the current is integrated by Simpson's rule in steps of 1 us. The error of a spike time is below 1 ns.

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace corpuscle::test {

// Times in s, forces in N.
inline constexpr double initial_time = 0.25, rise_time = 0.125, hold_time = 0.25, fall_time = 0.125, total_time = 1.0, F_min = 0.2,
                        F_max = 4;

/// The force (N) at time t (s).
inline double press_force(double t) {
    const double s =
        t < initial_time + rise_time ? (t - initial_time) / rise_time : 1 - (t - initial_time - rise_time - hold_time) / fall_time;
    return t < initial_time || t >= initial_time + rise_time + hold_time + fall_time ? F_min
           : t >= initial_time + rise_time && t < initial_time + rise_time + hold_time
               ? F_max
               : F_min + (F_max - F_min) * (1 - std::cos(M_PI * s)) / 2;
}

/// The press behind a high-pass filter with cutoff frequency f (Hz): the solution x (N) of x' + 2 pi f x = F', x(0) = 0, at time t (s).
inline double high_passed_press(double t, double f) {
    const double w = 2 * M_PI * f, omega = M_PI / rise_time, swing = (F_max - F_min) / 2 * omega / (w * w + omega * omega);
    const auto ramp = [&](double s) { return swing * (w * std::sin(omega * s) - omega * std::cos(omega * s) + omega * std::exp(-w * s)); };
    double x = 0;
    if (t > initial_time) x = ramp(std::min(t - initial_time, rise_time));
    if (t > initial_time + rise_time) x *= std::exp(-w * std::min(t - initial_time - rise_time, hold_time));
    const double s = std::min(t - initial_time - rise_time - hold_time, fall_time);
    if (s > 0) x = x * std::exp(-w * s) - ramp(s);
    if (t > initial_time + rise_time + hold_time + fall_time) x *= std::exp(-w * (t - initial_time - rise_time - hold_time - fall_time));
    return x;
}

// The receptors' currents (A) at time t (s).
inline double sa1_current(double t) {
    return 1e-6 * press_force(t) + std::max(8e-6 * high_passed_press(t, 20), 0.0) + std::max(2e-6 * high_passed_press(t, 2), 0.0);
}
inline double fa1_current(double t) {
    const double x = high_passed_press(t, 2);
    return x > 0 ? 3.5e-6 * x : -2.75e-6 * x;
}

/// Spike times (s) of the neuron LIF-B, with resting voltage 0, under current(t). leak: A; V_th, V_reset: V; C_m: F.
inline std::vector<double> lif_b_train(const std::function<double(double)>& current, double leak, double V_th, double V_reset,
                                       double C_m = 500e-9) {
    constexpr double h = 1e-6;
    std::vector<double> train;
    double u = 0, at_start = current(0) - leak;
    for (long k = 0; k < std::lround(total_time / h); ++k) {
        const double t = static_cast<double>(k) * h, at_end = current(t + h) - leak;
        const double end = std::max(u + h / 6 * (at_start + 4 * (current(t + h / 2) - leak) + at_end) / C_m, 0.0);
        if (end > V_th) train.push_back(t + h * (V_th - u) / (end - u));
        u = end > V_th ? end - V_th + V_reset : end;
        at_start = at_end;
    }
    return train;
}

}  // namespace corpuscle::test
