#pragma once
// .save: which curves are handed on.

#include "circuit/analysis/bench.hpp"
#include "circuit/curves.hpp"

namespace corpuscle::circuit {

/// What .save names: v(a), v(a,b), i(v1) ...; "out" is v(out). Empty: everything is meant.
Result<std::vector<std::string>> saved_of(const System&, const Circuit&);

/// The plot with the curves named, where it has one of them; a plot of another kind (noise, transfer function) as it is.
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
