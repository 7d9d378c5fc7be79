#pragma once
// Where a circuit rests: f(x) = 0, by Newton's steps, and by detours where they do not arrive.

#include <string>
#include <vector>

#include "circuit/solve/system.hpp"

namespace corpuscle::circuit {

/// When an answer is good enough, and how long to look for it. Names are SPICE's; ours are tighter, for picoamperes.
struct Tolerances {
    double reltol = 1e-6;
    double vntol = 1e-9;    ///< V
    double abstol = 1e-16;  ///< A
    double gmin = 1e-15;    ///< S
    int itl1 = 100;         ///< Newton's steps at the most in one attempt

    /// From .options; refuses what cannot be: a floor above 1e-16 A or 1e-15 S only if it is asked for.
    static Result<Tolerances> of(const Circuit&);
};

struct OperatingPoint {
    std::vector<double> x;
    std::string_view how;  ///< "newton", "gmin", "source", "pseudo-transient"
    int iterations = 0;    ///< Newton's steps, all attempts
};

/// Springs that pull nodes to where they are wanted: g (x - to) is added to each node's equation. Empty: none.
struct Springs {
    std::vector<double> g, to;
};

/// Newton's steps from x on; x is left where they ended. False: they did not arrive. Bound to its system, whose matrix it has analysed.
struct Newton {
    const System& system;
    Tolerances tolerances;
    Instant instant;
    Solver<double> solver;
    Sums sums;
    std::vector<double> memory;
    int iterations = 0;
    int singular = -1;  ///< the unknown at which the matrix was last found singular; -1: it was not
    std::vector<double> step;

    Newton(const System&, const Tolerances&);
    bool balanced() const;  ///< whether the last sums are as good as zero
    bool run(std::vector<double>& x, const Springs& = {}, int most = 0);
    /// Of the system at x: how far it is from an answer, in words.
    std::string distance(std::span<const double> x);
};

/// From `start`; if that is empty, from 0 everywhere, with .nodeset first. `held`: springs that stay to the end.
Result<OperatingPoint> operating_point(Newton&, std::vector<double> start = {}, Springs held = {});

}  // namespace corpuscle::circuit
