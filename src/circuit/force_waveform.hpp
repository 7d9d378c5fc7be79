#pragma once
// The force waveform that drives the force sources of a circuit; samples are appended while the simulation runs.

#include <cstdint>
#include <span>
#include <vector>

namespace corpuscle::circuit {

/// A piecewise linear waveform with samples every T seconds, the first at 0 s. Before the first sample and after the last the force is
/// constant. Old samples are discarded.
///
/// Not every sample is a breakpoint, because each breakpoint costs the circuit a time step. A sample is a breakpoint if the force bends
/// there much more sharply than two samples before or after. It is also one if the force deviates from the straight line through the
/// last breakpoint by more than 5 % of the largest force so far. Between breakpoints, error control of the step size is sufficient.
class ForceWaveform {
    double T_;
    std::int64_t first_ = 0;          // number of samples_[0]
    std::int64_t next_to_check_ = 1;  // the next sample that may be a breakpoint
    std::vector<double> samples_;
    std::vector<std::int64_t> breakpoints_;
    double line_from_ = 0, line_at_ = 0, line_slope_ = 0;  // the line from the last breakpoint: sample, N, N per sample
    double largest_ = 0;                                   // N, the largest magnitude of all samples that were checked

    double sample(std::int64_t k) const;
    double bend(std::int64_t k) const { return sample(k - 1) - 2 * sample(k) + sample(k + 1); }
    void check_next_sample();

public:
    explicit ForceWaveform(double T = 1) : T_(T) {}
    double T() const { return T_; }  ///< sample time, s

    void append(std::span<const double> force);
    /// The force at time t, N; t in s.
    double at(double t) const;
    /// The first breakpoint after t, s; infinity if none is known.
    double next_breakpoint(double t) const;
    /// Up to this time, s, neither values nor breakpoints depend on samples that are still to be appended.
    double known_until() const { return static_cast<double>(next_to_check_ - 1) * T_; }
    /// The number of samples after a sample that are needed to decide whether it is a breakpoint.
    static constexpr std::int64_t lookahead = 3;
    /// The number of the sample that will be appended next.
    std::int64_t end_sample() const { return first_ + static_cast<std::int64_t>(samples_.size()); }
    /// Discards samples before t, s, which must not be requested again.
    void discard_before(double t);
    /// Moves the origin of time, 0 s, to this sample.
    void shift_origin(std::int64_t samples);

    /// Writes the complete state as numbers. restore() reads them; it returns false if they cannot come from save().
    void save(std::vector<double>& out) const;
    bool restore(std::span<const double> in);
};

}  // namespace corpuscle::circuit
