#pragma once
// The waveform of an independent source.

#include "circuit/netlist/netlist.hpp"

namespace corpuscle::circuit {

/// A waveform as the line of a source gives it: its name, then numbers.
struct WaveformSyntax {
    std::string_view name;
    Waveform::Shape shape;
    std::size_t min_numbers, max_numbers;  ///< allowed counts of numbers after the name
    std::string_view usage;
};
inline constexpr WaveformSyntax waveform_syntaxes[] = {
    {"pulse", Waveform::Shape::pulse, 2, 8, "pulse(v1 v2 td tr tf pw per np)"},
    {"sin", Waveform::Shape::sine, 2, 7, "sin(vo va freq td theta phase ncycles)"},
    {"exp", Waveform::Shape::exponential, 2, 6, "exp(v1 v2 td1 tau1 td2 tau2)"},
    {"pwl", Waveform::Shape::piecewise_linear, 2, 2000000, "pwl(t1 v1 t2 v2 ...)"},
    {"sffm", Waveform::Shape::frequency_modulated, 2, 7, "sffm(vo va fc mdi fs phasec phases)"},
    {"am", Waveform::Shape::amplitude_modulated, 2, 6, "am(va vo mf fc td phase)"},
    {"trnoise", Waveform::Shape::noise, 2, 7, "trnoise(na nt 0 0)"},
    {"force", Waveform::Shape::force, 0, 1, "force [scale]"},
};

class ElementReader;
/// Reads the DC value, AC value and waveform of a V or I source, which follow the nodes in its line.
Result<void> read_waveform(ElementReader&);

/// PULSE, SIN, EXP, PWL, SFFM and AM as in SPICE, and the white noise of ngspice's TRNOISE. Defaults depend on the step and the end time of
/// .tran (s). Rise and fall times and the time constants of EXP are `step`. The pulse width is `stop`, and the period is `stop` or one
/// complete pulse if that is longer. The frequency of a sine is 1 / `stop`.
class SourceWaveform {
    Waveform wave_;
    double step_ = 0, stop_ = 0;
    std::uint64_t seed_;               // of TRNOISE
    std::vector<double> breakpoints_;  // s, ascending; not used by PULSE

    /// Argument k of the waveform; `fallback` if it is missing.
    double number(std::size_t k, double fallback) const { return k < wave_.numbers.size() ? wave_.numbers[k] : fallback; }
    double positive_or(std::size_t k, double fallback) const { return number(k, 0) > 0 ? number(k, 0) : fallback; }
    struct PulseTimes {
        double rise, fall, width, period;  // s
    };
    double next_repeated_breakpoint(double t) const;
    PulseTimes pulse_times() const;
    double pulse(double t) const;
    double sine(double t) const;
    /// The frequency of SIN, Hz.
    double frequency() const { return number(2, 0) > 0 ? number(2, 0) : 1 / stop_; }
    double exponential(double t) const;
    double frequency_modulated(double t) const;
    double amplitude_modulated(double t) const;
    double noise(double t) const;
    std::int64_t noise_interval(double t) const;
    /// The time of the first cycle of a repeated PWL that corresponds to t.
    double in_first_cycle(double t) const;
    double piecewise_linear(double t) const;

public:
    /// `step`, `stop`: those of .tran, s. `seed`: of the random numbers of TRNOISE.
    SourceWaveform(Waveform, double step, double stop, std::uint64_t seed = 0);

    double at(double t) const;  ///< V or A, at t in s
    /// The first time after t (s) with a kink or a jump; infinity if there is none.
    double next_breakpoint(double t) const;
    /// A tenth of the shortest period of SIN, SFFM or AM, s; infinity for the other waveforms.
    double max_step() const;
};

}  // namespace corpuscle::circuit
