#pragma once

#include "model/neuron/substeps.hpp"

namespace corpuscle {

/// Adaptive exponential integrate-and-fire, Brette and Gerstner 2005:
///
///     C_m dv/dt = -g_L (v - E_L) + g_L Delta_T exp((v - V_T) / Delta_T) - w + gain I,   tau_w dw/dt = a (v - E_L) - w
///     v > V_peak  =>  spike, then v = V_reset and w = w + b
///
/// v is the membrane potential, w the adaptation current and I the receptor's current. The exponential is limited to its value at V_peak.
/// Method has no effect: the substeps are always the same. There is no refractory time; adaptation limits the rate instead.
struct AdexTraits {
    static constexpr std::string_view name = "adex", description = "adaptive exponential integrate-and-fire";
    static constexpr std::string_view source = "Brette and Gerstner 2005, J Neurophysiol 94:3637; thesis 3.2";
    static constexpr ParameterInfo parameters[] = {
        {"C_m", "F", 281e-12, 1e-15, 1, "membrane capacitance"},
        {"g_L", "S", 30e-9, 1e-15, 1, "leak conductance"},
        {"E_L", "V", -70.6e-3, -0.2, 0.1, "resting potential"},
        {"V_T", "V", -50.4e-3, -0.2, 0.1, "threshold of the exponential"},
        {"Delta_T", "V", 2e-3, 1e-4, 0.1, "width of the exponential"},
        {"a", "S", 4e-9, -1e-3, 1e-3, "adaptation conductance"},
        {"b", "A", 80.5e-12, 0, 1, "increase of the adaptation current w at a spike"},
        {"tau_w", "s", 144e-3, 1e-4, 1e3, "time constant of adaptation"},
        {"V_peak", "V", -40.4e-3, -0.2, 0.1, "potential at which a spike is counted",
         "choice: V_T + 5 Delta_T; from there to the paper's 20 mV takes under 0.1 ms"},
        {"V_reset", "V", -70.6e-3, -0.2, 0.1, "potential after a spike"},
        {"gain", "", 3e-4, 0, 1e6, "gain from the receptor's current to the membrane current",
         "choice: firing rates of tens of hertz for currents of microamperes"},
        {"substep", "s", 20e-6, 1e-8, 1e-3, "longest substep (at most a million substeps per sample)", "choice", true},
    };
    static constexpr ParameterOrder order_constraints[] = {
        {"V_reset", "V_peak"},
        {"E_L", "V_T"},
    };
    static constexpr Probe recordables[] = {{"v", "V"}, {"w", "A"}};
};

template <class T>
struct Adex : AdexTraits {
    using State = MembraneRecovery<T>;  // V; A

    template <class Values>
    Adex(const Values& value, double dt, Method)
        : C_m(value("C_m")), g_L(value("g_L")), E_L(value("E_L")), V_T(value("V_T")), Delta_T(value("Delta_T")), a(value("a")),
          b(value("b")), tau_w(value("tau_w")), V_peak(value("V_peak")), V_reset(value("V_reset")), gain(value("gain")), dt(dt),
          count(substep_count(dt, value.uniform("substep"))) {}

    /// The resting state. The exponential raises its v slightly above E_L; v is found by Newton's method.
    State start() const {
        T v = E_L, step = T(0.0);
        for (int pass = 0; pass < 12; ++pass) {
            const T e = num::exp((v - V_T) / Delta_T);
            step = (-(g_L + a) * (v - E_L) + g_L * Delta_T * e) / (g_L + a - g_L * e);
            v = v + step;
        }
        // If there is no resting state between E_L and V_T, the neuron starts at E_L.
        v = num::select((num::abs(step) < T(1e-9)) & (v >= E_L) & (v < V_T), v, E_L);
        return {v, a * (v - E_L)};
    }
    void record(const State& s, T (&out)[2]) const { out[0] = s.v, out[1] = s.w; }

    /// Simulates one step under current i. For each spike calls fired(mask, offset): the lanes that fire, and the offset of the spike
    /// within the step. Returns an empty mask, because no limit of spikes truncates the step.
    template <class Fired>
    num::Mask<T> step(State& s, Current<T> i, Fired&& fired) const {
        const auto slopes = [this](State at, T current) {
            const T upstroke = g_L * Delta_T * num::exp((num::min(at.v, V_peak) - V_T) / Delta_T);
            return State{(g_L * (E_L - at.v) + upstroke - at.w + gain * current) / C_m, (a * (at.v - E_L) - at.w) / tau_w};
        };
        advance_substeps(s, i, dt, count, V_peak, slopes, [this](State at) { return State{V_reset, at.w + b}; }, fired);
        return num::empty_mask<T>();
    }

private:
    T C_m, g_L, E_L, V_T, Delta_T, a, b, tau_w, V_peak, V_reset, gain;
    double dt;
    int count;  // substeps per step
};

}  // namespace corpuscle
