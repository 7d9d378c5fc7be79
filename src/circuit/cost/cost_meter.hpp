#pragma once
// Computes the cost of a circuit while the directives of its netlist run.

#include "circuit/cost/cost.hpp"
#include "circuit/run_directives.hpp"

namespace corpuscle::circuit {

/// Measures power over a transient while it runs, and adds the power at the operating point, area and leakage afterwards.
class CostMeter {
    AnalysisContext& context_;
    std::optional<PowerMeter> meter_;
    std::optional<PowerOverTime> power_over_time_;

public:
    explicit CostMeter(AnalysisContext& context) : context_(context) {}
    CostMeter(const CostMeter&) = delete;
    /// Makes the options of a run pass the points of its transient to this meter, which must outlive them.
    Result<void> attach(RunOptions& options);
    /// The cost; call it after the run.
    Result<Cost> cost() const { return cost_of(context_, power_over_time_ ? &*power_over_time_ : nullptr); }
};

}  // namespace corpuscle::circuit
