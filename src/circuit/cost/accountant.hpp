#pragma once
// Computes the cost of a circuit while the directives of its netlist run.

#include "circuit/cost/cost.hpp"
#include "circuit/run.hpp"

namespace corpuscle::circuit {

/// Measures power over a transient while it runs, and adds area and leakage afterwards.
class Accountant {
    TestBench& context_;
    std::optional<PowerMeter> meter_;
    std::optional<PowerOverTime> over_;

public:
    explicit Accountant(TestBench& context) : context_(context) {}
    Accountant(const Accountant&) = delete;
    /// Connects the meter to the options of a run. The options must not outlive this object.
    Result<void> watch(RunOrders& options);
    /// The cost; call it after the run.
    Result<Cost> found() const { return cost_of(context_, over_ ? &*over_ : nullptr); }
};

}  // namespace corpuscle::circuit
