#pragma once
// Devices on lanes, and their way from a circuit's unknowns and back into its equations.

#include "circuit/solve/system.hpp"

namespace corpuscle::circuit {

/// All groups of a system. Numbers go by lists made once: a voltage to each terminal from its unknown, to each place of the matrix the
/// slopes that meet there. Vectors of unknowns here have one number more at their end, of ground.
class SideBySide {
    struct Part {
        const Group& group;
        std::size_t at;  // where its numbers begin: v, f, q [terminals][room]; df, dq [terminals^2][room]
    };
    struct alignas(64) Line {
        double of[8];
    };
    /// Sums of numbers, those of so many terms together.
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
    std::vector<int> terminals_;  // of each part's v, one part after another
    Sums slopes_, currents_, charges_;

    double* numbers() { return lines_.empty() ? nullptr : lines_[0].of; }
    static Sums sums_of(std::vector<std::pair<int, int>> to_from);

public:
    explicit SideBySide(const System&);
    SideBySide(const SideBySide&) = delete;

    /// All devices at x; f + rate q is added to r, and df + rate dq to J.
    void look(const Instant&, double rate, const std::vector<double>& x, std::vector<double>& J, std::vector<double>& r);
    /// Adds the charges at `step` from where they were looked at, along their slopes, to q. Once after each look.
    void charges(const std::vector<double>& step, std::vector<double>& q);
};

}  // namespace corpuscle::circuit
