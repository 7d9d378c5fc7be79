#pragma once
// Selects some curves of a plot, for example the curves that .save names.

#include "circuit/analysis/analysis_context.hpp"
#include "circuit/curve_view.hpp"

namespace corpuscle::circuit {

/// The plot with only the named curves. If `names` is empty, or the plot has none of them (noise, transfer function), all curves remain.
Plot select_curves(const Plot&, const std::vector<std::string>& names);

/// The same for a plot that comes point by point.
class CurveSelector {
    std::vector<CurveView> views_;
    std::vector<double> row_;
    bool keeps_all_ = true;

public:
    /// Takes the curves of a plot without their values, and returns the selected ones.
    Plot begin(const Plot& head, const std::vector<std::string>& names);
    /// The selected values of a point; valid until the next call.
    std::span<const double> select(std::span<const double> row);
};

}  // namespace corpuscle::circuit
