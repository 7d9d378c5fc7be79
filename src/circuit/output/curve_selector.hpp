#pragma once
// Selects some curves of a plot, for example the curves that .save names.

#include "circuit/analysis/analysis_context.hpp"
#include "circuit/output/curve_view.hpp"

namespace corpuscle::circuit {

/// The plot with only the named curves. If `names` is empty, or the plot has none of them (noise, transfer function), all curves remain.
Plot select_curves(const Plot&, const std::vector<std::string>& names);

/// Does the same for a plot that arrives point by point. The plot must have a swept quantity.
class CurveSelector {
    std::vector<CurveView> views_;
    std::vector<double> row_;
    bool keeps_all_ = true;

public:
    /// Takes the curves of a plot, without values, and returns the selected curves, without values.
    Plot begin(const Plot& head, const std::vector<std::string>& names);
    /// The values of the selected curves at a point. `row` has a value for each curve of the plot. The span is valid until the next call.
    std::span<const double> select(std::span<const double> row);
};

}  // namespace corpuscle::circuit
