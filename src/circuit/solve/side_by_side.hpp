#pragma once
// Evaluates devices on SIMD lanes: gathers their voltages from the unknowns and scatters the results into the equations.

#include "circuit/solve/system.hpp"

namespace corpuscle::circuit {

/// All device groups of a system. Index lists are made once: the unknown of each terminal, and the derivatives that add up to each matrix
/// entry. Vectors of unknowns have one more element at the end, for ground.
class SideBySide {
    struct Part {
        const Group& group;
        std::size_t at;  // start of its values: v, f, q [terminals][stride]; df, dq [terminals^2][stride]
    };
    struct alignas(64) Line {
        double of[8];
    };
    /// Index lists that add values to targets, grouped by the number of terms of each target.
    struct Sums {
        struct Run {
            int terms, count;
        };
        std::vector<Run> runs;
        std::vector<int> to, from;
        void add(const double* numbers, double* out) const;
    };
    std::vector<Part> parts_;
    std::vector<Line> lines_;
    std::vector<int> terminals_;  // unknown of each element of v, one buffer after another
    Sums slopes_, currents_, charges_;

    double* numbers() { return lines_.empty() ? nullptr : lines_[0].of; }
    static Sums sums_of(std::vector<std::pair<int, int>> to_from);

public:
    explicit SideBySide(const System&);
    SideBySide(const SideBySide&) = delete;

    /// Evaluates all devices at x; adds f + rate q to r, and df + rate dq to J.
    void look(const Instant&, double rate, const std::vector<double>& x, std::vector<double>& J, std::vector<double>& r);
    /// Adds the charges after `step`, extrapolated linearly from the last evaluation, to q. Call at most once after each evaluate().
    void charges(const std::vector<double>& step, std::vector<double>& q);
};

}  // namespace corpuscle::circuit
