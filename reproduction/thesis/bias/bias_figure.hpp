#pragma once
// Figs. 53 to 55 show the same curves over I_BIAS, supply voltage and temperature: the body voltages in the typical corner, and the
// replica's current I_Q in all corners.

#include "reproduction/claims/study.hpp"
#include "reproduction/thesis/bias/bias_sweep.hpp"

namespace corpuscle {

struct BiasFigure {
    BiasAxis axis;
    const char *number, *x_label, *unit;  ///< "53", "I_BIAS (nA)", "A"
    double plot_scale;                    ///< factor of the x axis: 1e9, A to nA
    double typical_range[2];              ///< published working range in the typical corner, from and to, in `unit`
    double corner_range[2];               ///< the same over all corners; NaN: not published
    double axis_start = Claim::none;      ///< where the published figure's axis begins, if the typical range begins there, too

    std::string source() const { return std::string("thesis E.2, fig. ") + number; }
};

struct BiasCorner {
    const char* name;
    BiasSweep sweep;
    BiasSweep::Range working_range;
};

/// Sweeps the corners tt, ss and ff, and returns them in this order. Adds the claims on the working range, and the plots.
Result<std::vector<BiasCorner>> simulate_bias_figure(const BiasFigure&, StudyResult&, const StudyOptions&);

/// Explains why the working range begins or ends at `end`, a value on the sweep's axis. `reaches_sweep_end` is true if the sweep itself
/// begins or ends there, and the generator still works.
Result<std::string> explain_range_end(const BiasSweep&, double end, bool reaches_sweep_end);

}  // namespace corpuscle
