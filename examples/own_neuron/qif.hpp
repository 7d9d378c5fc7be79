#pragma once

#include "core/afferent.hpp"
#include "core/parameter.hpp"
#include "model/current.hpp"
#include "model/neuron/substeps.hpp"

namespace corpuscle {

/// Quadratic integrate-and-fire:   C_m du/dt = g (u - E_L) (u - V_T) / (V_T - E_L) + I
///     u > V_peak  =>  spike, then u = V_reset
/// Latham et al. 2000, J Neurophysiol 83:808. The
/// integration method has no effect, because the substeps are always the same. There is no refractory time.
struct QifTraits {
    static constexpr std::string_view name = "qif", description = "quadratic integrate-and-fire";
    static constexpr std::string_view source = "Latham et al. 2000, J Neurophysiol 83:808; values are our choice";
    static constexpr ParameterInfo parameters[] = {
        {"C_m", "F", 500e-9, 1e-18, 1, "membrane capacitance"},
        {"g", "S", 5e-6, 1e-15, 1, "conductance at rest"},
        {"E_L", "V", 0, -10, 10, "resting potential"},
        {"V_T", "V", 0.25, -10, 10, "unstable equilibrium without current"},
        {"V_peak", "V", 0.5, -10, 10, "top of a spike"},
        {"V_reset", "V", 0, -10, 10, "membrane after a spike"},
        {"substep", "s", 20e-6, 1e-8, 1e-3, "longest substep", "choice", true},
    };
    static constexpr ParameterOrder order_constraints[] = {
        {"E_L", "V_T"},
        {"V_T", "V_peak"},
        {"V_reset", "V_peak"},
    };
    static constexpr Probe recordables[] = {{"u", "V"}};
};

template <class T>
struct Qif : QifTraits {
    struct State {
        T u;
    };

    template <class Values>
    Qif(const Values& value, double dt, Method)
        : E_L(value("E_L")), V_T(value("V_T")), V_peak(value("V_peak")), V_reset(value("V_reset")), gain(T(1.0) / value("C_m")),
          bend(value("g") * gain / (V_T - E_L)), dt(dt), count(substep_count(dt, value.uniform("substep"))) {}

    State start() const { return {E_L}; }
    void record(const State& s, T (&out)[1]) const { out[0] = s.u; }

    /// One step under current i. Calls fired(mask, offset) for each spike in it; offset is the time since the start of the step, in steps.
    template <class Fired>
    num::Mask<T> step(State& s, Current<T> i, Fired&& fired) const {
        MembraneRecovery<T> y{s.u, T(0.0)};  // the second variable is not used
        const auto slopes = [this](MembraneRecovery<T> at, T current) {
            const T u = num::min(at.v, V_peak);  // the parabola is limited to its value at V_peak
            return MembraneRecovery<T>{bend * (u - E_L) * (u - V_T) + gain * current, T(0.0)};
        };
        advance_substeps(
            y, i, dt, count, V_peak, slopes, [this](MembraneRecovery<T> at) { return MembraneRecovery<T>{V_reset, at.w}; }, fired);
        s.u = y.v;
        return num::empty_mask<T>();  // no step is truncated: there is at most one spike per substep
    }

private:
    T E_L, V_T, V_peak, V_reset, gain, bend;
    double dt;
    int count;
};

}  // namespace corpuscle
