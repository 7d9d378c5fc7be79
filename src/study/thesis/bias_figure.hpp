#pragma once
// Figs. 53 to 55 have the same form along three axes: the body voltages in the typical corner, and the replica's current in the corners.

#include "study/study.hpp"
#include "study/thesis/bias_sweep.hpp"

namespace corpuscle {

struct BiasFigure {
    BiasAxis axis;
    const char *number, *x_label, *unit;  ///< "53", "I_BIAS (nA)", "A"
    double plot_scale;                    ///< factor of the x axis: 1e9, A to nA
    double typical_range[2];              ///< published working range
    double corner_range[2];               ///< the same over all corners; NaN: not published

    std::string source() const { return std::string("thesis E.2, fig. ") + number; }
};

struct BiasCorner {
    const char* name;
    BiasSweep sweep;
    BiasSweep::Range working_range;
};

/// Sweeps the corners tt, ss and ff; adds the claims on the working range and both plots.
Result<std::vector<BiasCorner>> simulate_bias_figure(const BiasFigure&, StudyResult&, const StudyOptions&);

/// The reason why the generator works no further than to this end. `reaches_sweep_end`: it works to the end of the sweep, without a limit.
Result<std::string> explain_range_end(const BiasSweep&, double end, bool reaches_sweep_end);

}  // namespace corpuscle
