#pragma once
// The waveform of an independent source.

#include <vector>

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// PULSE, SIN, EXP and PWL as in SPICE. Defaults depend on the step and the end time of .tran (s). Rise and fall times and the time
/// constants of EXP are `step`. The pulse width is `stop`, and the period is `stop` or one complete pulse if that is longer. The frequency
/// of a sine is 1 / `stop`.
class SourceWaveform {
    Waveform wave_;
    double step_ = 0, stop_ = 0;
    std::vector<double> breakpoints_;  // s, ascending; not used by PULSE

    /// Argument k of the waveform; `fallback` if it is missing.
    double number(std::size_t k, double fallback) const { return k < wave_.numbers.size() ? wave_.numbers[k] : fallback; }
    double pulse(double t) const;
    double sine(double t) const;
    /// The frequency of SIN, Hz.
    double frequency() const { return number(2, 0) > 0 ? number(2, 0) : 1 / stop_; }
    double exponential(double t) const;
    double piecewise_linear(double t) const;

public:
    /// `step`, `stop`: those of .tran, s.
    SourceWaveform(Waveform, double step, double stop);

    double at(double t) const;  ///< V or A, at t in s
    /// The first time after t (s) with a kink or a jump; infinity if there is none.
    double next_breakpoint(double t) const;
    /// A tenth of a sine's period, s; infinity for the other waveforms.
    double max_step() const;
};

}  // namespace corpuscle::circuit
