#pragma once

#include "circuit/run_directives.hpp"
#include "corpuscle/circuit.hpp"

namespace corpuscle::api {

/// Collects curves as columns.
class ColumnCollector final : public circuit::PointSink {
public:
    std::vector<CircuitPlot> plots;

    Result<void> begin(const circuit::Plot& head) override;
    Result<void> add_point(const circuit::PlotRow&) override;
};

/// Sets the analyses of collected plots, and the units that depend on them.
void name_analyses(std::vector<CircuitPlot>&, const circuit::RunOutcome&);

}  // namespace corpuscle::api
