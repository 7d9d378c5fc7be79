#pragma once

#include "model/neuron/substeps.hpp"

namespace corpuscle {

/// Izhikevich 2003, in SI:   dv/dt = 4e4 v^2 + 5e3 v + 140 - w + gain I,   dw/dt = a (b v - w)      (v in V, w in V/s, t in s)
///     v > V_peak  =>  spike, then v = c and w = w + d
///
/// v is the membrane potential, w the recovery (the paper's u) and I the receptor's current. The coefficients are the paper's 0.04, 5 and
/// 140, which apply to mV and ms. Likewise the paper's a = 0.02/ms is 20 1/s, b = 0.2/ms is 200 1/s, and d = 8 mV/ms is 8 V/s. Method has
/// no effect: the substeps are always the same. There is no refractory time; the recovery w takes its role. Thesis 3.2 mentions the model
/// because it adapts.
struct IzhikevichTraits {
    static constexpr std::string_view name = "izhikevich", description = "Izhikevich 2003: quadratic membrane with recovery";
    static constexpr std::string_view source = "Izhikevich 2003, IEEE Trans Neural Netw 14:1569 (regular spiking); thesis 3.2";
    static constexpr ParameterInfo parameters[] = {
        {"a", "1/s", 20, 1e-3, 1e5, "rate at which w approaches b v"},
        {"b", "1/s", 200, -1e5, 1e5, "ratio of w to v in the steady state of w"},
        {"c", "V", -65e-3, -0.2, 0.02, "potential after a spike"},
        {"d", "V/s", 8, -1e3, 1e3, "increase of w at a spike"},
        {"V_peak", "V", 30e-3, -0.03, 0.2, "potential at which a spike is counted"},
        {"gain", "V/s/A", 2.5e6, 0, 1e15, "gain from the receptor's current to dv/dt",
         "choice: firing rates of tens of hertz for currents of microamperes"},
        {"substep", "s", 20e-6, 1e-8, 1e-3, "longest substep (at most a million substeps per sample)", "choice", true},
    };
    static constexpr ParameterOrder order_constraints[] = {
        {"c", "V_peak"},
    };
    static constexpr Probe recordables[] = {{"v", "V"}, {"w", "V/s"}};
};

template <class T>
struct Izhikevich : IzhikevichTraits {
    using State = MembraneRecovery<T>;  // V; V/s

    template <class Values>
    Izhikevich(const Values& value, double dt, Method)
        : a(value("a")), b(value("b")), c(value("c")), d(value("d")), V_peak(value("V_peak")), gain(value("gain")), dt(dt),
          count(substep_count(dt, value.uniform("substep"))) {}

    /// The stable resting state without current, at which dv/dt = dw/dt = 0. If there is none, v = c.
    State start() const {
        const T p = T(5e3) - b, discriminant = p * p - T(4 * 4e4 * 140);
        const T v = num::select(discriminant > T(0.0), (-p - num::sqrt(num::positive_part(discriminant))) / T(8e4), c);
        return {v, b * v};
    }
    void record(const State& s, T (&out)[2]) const { out[0] = s.v, out[1] = s.w; }

    /// Simulates one step under current i. For each spike calls fired(mask, offset): the lanes that fire, and the offset of the spike
    /// within the step. Returns an empty mask, because no limit of spikes truncates the step.
    template <class Fired>
    num::Mask<T> step(State& s, Current<T> i, Fired&& fired) const {
        const auto slopes = [this](State at, T current) {
            const T v = num::min(at.v, V_peak);  // the parabola is limited to its value at V_peak
            return State{v * (T(4e4) * v + T(5e3)) + T(140.0) - at.w + gain * current, a * (b * v - at.w)};
        };
        advance_substeps(s, i, dt, count, V_peak, slopes, [this](State at) { return State{c, at.w + d}; }, fired);
        return num::empty_mask<T>();
    }

private:
    T a, b, c, d, V_peak, gain;
    double dt;
    int count;  // substeps per step
};

}  // namespace corpuscle
