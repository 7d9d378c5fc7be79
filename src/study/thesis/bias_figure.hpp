#pragma once
// Figs. 53 to 55 are one figure along three axes: the body voltages, typical, and the replica's current in the corners.

#include "study/study.hpp"
#include "study/thesis/bias_sweep.hpp"

namespace corpuscle {

struct BiasFigure {
    BiasAxis axis;
    const char *number, *x_label, *unit;  ///< "53", "I_BIAS (nA)", "A"
    double scale;                         ///< of what is drawn: 1e9, A to nA
    double typical[2];                    ///< printed: where it works
    double corners[2];                    ///< the same over all corners; NaN: not printed

    std::string source() const { return std::string("thesis E.2, fig. ") + number; }
};

struct BiasCorner {
    const char* name;
    BiasSweep sweep;
    BiasSweep::Range works;
};

/// Swept in tt, ss and ff; the claims on where it works, and both plots.
Result<std::vector<BiasCorner>> make(const BiasFigure&, Outcome&, const StudyOptions&);

/// What stops it where its range ends.
Result<std::string> why_it_ends(const BiasSweep&, double end, bool open);

}  // namespace corpuscle
