#pragma once
// Plots with some of their curves: those that .save names.

#include "circuit/analysis/bench.hpp"
#include "circuit/curves.hpp"

namespace corpuscle::circuit {

/// The plot with the curves named (none: all of them), where it has one of them; a plot of another kind (noise, transfer function) as it
/// is.
Plot narrowed(const Plot&, const std::vector<std::string>& names);

/// The same of points as they come.
class Narrow {
    std::vector<CurveView> views_;
    std::vector<double> row_;
    bool all_ = true;

public:
    /// The head of what comes out.
    Plot begin(const Plot& head, const std::vector<std::string>& names);
    std::span<const double> point(std::span<const double> row);
};

}  // namespace corpuscle::circuit
