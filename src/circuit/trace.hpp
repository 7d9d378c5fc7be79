#pragma once
// Force as it comes, for the sources that carry it.

#include <cstdint>
#include <span>
#include <vector>

namespace corpuscle::circuit {

/// Straight lines between samples a T apart, the first at 0 s; before it and after the last the force stands still. Samples are appended as
/// they come and forgotten when time has passed them.
///
/// Its corners are not all its samples, which would cost a circuit a step each, but those that a step must not pass: where the force bends
/// far sharper than two samples before or after, and where it has left the straight line from the last corner by a part of the largest
/// force so far. What lies between bends so little that a step's own error tells.
class Trace {
    double T_;
    std::int64_t first_ = 0;   // number of samples_[0]
    std::int64_t looked_ = 1;  // the next sample that may prove a corner
    std::vector<double> samples_;
    std::vector<std::int64_t> corners_;
    double line_from_ = 0, line_at_ = 0, line_slope_ = 0;  // sample, N, N a sample: the line from the last corner
    double largest_ = 0;                                   // N, of all samples looked at

    double sample(std::int64_t k) const;
    double bend(std::int64_t k) const { return sample(k - 1) - 2 * sample(k) + sample(k + 1); }
    void look();

public:
    explicit Trace(double T = 1) : T_(T) {}
    double T() const { return T_; }

    void append(std::span<const double> force);
    double at(double t) const;
    /// The first corner after t, s; infinity: none is known.
    double next_corner(double t) const;
    /// s: up to here neither values nor corners depend on what is still to come.
    double known() const { return static_cast<double>(looked_ - 1) * T_; }
    /// How many samples before the last, at the most.
    static constexpr std::int64_t lag = 3;
    /// The number of the sample that comes next.
    std::int64_t end() const { return first_ + static_cast<std::int64_t>(samples_.size()); }
    /// What is before t is not asked for again.
    void forget(double t);
    /// From now on 0 s is where this sample was.
    void shift(std::int64_t samples);

    /// All of it as numbers; and back, false if they cannot be what save() gave.
    void save(std::vector<double>& out) const;
    bool restore(std::span<const double> in);
};

}  // namespace corpuscle::circuit
