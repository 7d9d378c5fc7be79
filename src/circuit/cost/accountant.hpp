#pragma once
// What a run costs: looks on while a netlist's orders are carried out.

#include "circuit/cost/cost.hpp"
#include "circuit/run.hpp"

namespace corpuscle::circuit {

class Accountant {
    TestBench& bench_;
    std::optional<PowerMeter> meter_;
    std::optional<PowerOverTime> over_;

public:
    explicit Accountant(TestBench& bench) : bench_(bench) {}
    Accountant(const Accountant&) = delete;
    /// From now on, through these orders, which must not outlive it.
    Result<void> watch(RunOrders&);
    /// After the run.
    Result<Cost> found() const { return cost_of(bench_, over_ ? &*over_ : nullptr); }
};

}  // namespace corpuscle::circuit
