#pragma once
// A circuit's equations in time, integrated by somebody else: IDA of SUNDIALS, at tolerances far tighter than ours.

#include <span>
#include <string>
#include <vector>

#include "circuit/solve/system.hpp"

namespace corpuscle::circuit {

/// What is asked of IDA. Crossings: when this unknown rises through this level.
struct IdaOptions {
    double step = 0, stop = 0;           ///< s: of the analysis, as sources take them
    std::vector<double> output_times{};         ///< s, in order: where x is wanted
    int crossing_unknown = -1;                    ///< an unknown; -1: none
    double crossing_level = 0;                    ///< V
    double reltol = 1e-9, vntol = 1e-9;  ///< V; charges alike, as their node's capacitance times this
    long max_steps = 20'000'000;              ///< steps
};

struct IdaResult {
    std::vector<std::vector<double>> x;  ///< at the times asked for
    std::vector<double> crossings;       ///< s
    long steps = 0, evaluations = 0;
    std::string error;  ///< why it did not get to the end; empty: it did
};

/// From x at t = 0 on.
///     f(x, t) + dq/dt = 0,   q - q(x) = 0   in the unknowns (x, q): charge is kept where nodes jump.
/// It stops at each corner of a source and begins anew there. A current through a source is a slope of a charge, so it is not judged.
IdaResult integrate_with_ida(System&, double gmin, const std::vector<double>& start, const IdaOptions&);

}  // namespace corpuscle::circuit
