#pragma once
// The force waveform that drives the force sources of a circuit, to which samples are appended while the simulation runs; and .force, the
// default force of a netlist, used if the caller provides no force.

#include "circuit/netlist/netlist.hpp"
#include "circuit/solve/state_archive.hpp"
#include "core/force_source.hpp"

namespace corpuscle::circuit {

/// A piecewise linear waveform with samples every T seconds. Sample k is at time k T. Before the first sample and after the last, the force
/// is constant. discard_before() frees the memory of old samples.
///
/// Not every sample is a breakpoint, because each breakpoint costs the circuit a time step. The bend at sample k is the second difference
/// of the force. A sample is a breakpoint if its bend is not negligible and more than 4 times the bend at sample k - 2 or at sample k + 2.
/// It is also one if the force deviates by more than 5 % of the largest force so far from the straight line that leaves the last breakpoint
/// (at first, sample 0) with the slope there. Between breakpoints, error control of the step size is sufficient.
class ForceWaveform {
    double T_;
    std::int64_t first_ = 0;          // samples_[0] is sample number first_
    std::int64_t next_to_check_ = 1;  // the first sample for which it is not yet decided whether it is a breakpoint
    std::vector<double> samples_;
    std::vector<std::int64_t> breakpoints_;  // sample numbers, in increasing order
    // The straight line from the last breakpoint: its sample number, the force there (N) and the slope (N per sample).
    double line_from_ = 0, line_at_ = 0, line_slope_ = 0;
    double largest_ = 0;  // N, the largest magnitude of the force so far

    double sample(std::int64_t k) const;
    double bend(std::int64_t k) const { return sample(k - 1) - 2 * sample(k) + sample(k + 1); }
    void check_next_sample();

public:
    explicit ForceWaveform(double T = 1) : T_(T) {}
    double T() const { return T_; }  ///< sample time, s

    void append(std::span<const double> force);
    /// The force at time t, N; t in s.
    double at(double t) const;
    /// The time of the first breakpoint after time t, s; infinity if no later breakpoint is known.
    double next_breakpoint(double t) const;
    /// Up to this time, s, neither values nor breakpoints depend on samples that are still to be appended.
    double known_until() const { return static_cast<double>(next_to_check_ - 1) * T_; }
    /// The number of samples after a sample that are needed to decide whether it is a breakpoint.
    static constexpr std::int64_t lookahead = 3;
    /// The number of the sample that append() will add first.
    std::int64_t end_sample() const { return first_ + static_cast<std::int64_t>(samples_.size()); }
    /// Discards samples and breakpoints before time t, s. at() must not be called again for earlier times.
    void discard_before(double t);
    /// Moves the origin of time by this number of samples: sample number `samples` becomes number 0, at 0 s.
    void shift_origin(std::int64_t samples);

    /// Writes or reads the complete state, except T. It must be the last of an archive.
    void archive(StateArchive&);
};

/// Reads .force STIMULUS [PARAMETER=VALUE ...] [rate=10k], such as ".force press f_max=2". STIMULUS is the name of a stimulus or a sum
/// such as press+noise. In a sum, a parameter is written with its stimulus: press.f_max. The sample rate is in Hz. Returns nothing if
/// the netlist has no .force.
Result<std::optional<ForceWaveform>> force_directive(const Circuit&);
/// The phases of the stimulus in .force; empty if the netlist has no .force or the stimulus has no phases.
Result<std::vector<Phase>> force_phases(const Circuit&);

/// "pwl(0 0.2 0.25 0.2 ...)" in several lines: the force of .force times `scale` (V/N or A/N). It differs from the samples of the force by
/// at most 1e-4 of the largest force. "" if the netlist has no .force.
Result<std::string> pwl_force(const Circuit&, double scale);

}  // namespace corpuscle::circuit
