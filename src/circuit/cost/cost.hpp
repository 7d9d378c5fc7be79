#pragma once
// The cost of a circuit: power, area, leakage.

#include "circuit/analysis/analysis_context.hpp"
#include "circuit/cost/area.hpp"
#include "circuit/cost/leakage_cost.hpp"
#include "circuit/cost/power.hpp"

namespace corpuscle::circuit {

/// Area and leakage of one block.
struct BlockCost {
    std::string name;
    std::size_t transistors = 0;       ///< number of transistors; an array counts as one
    std::size_t unit_transistors = 0;  ///< number of unit transistors that these consist of
    Area area;
    Leakage worst_leak;      ///< of the transistor with the largest leakage current
    std::string worst_name;  ///< its name; "" if the block has no transistor
};

/// The cost of a complete circuit.
struct Cost {
    double supply = 0;                 ///< V: voltage of the source that delivers the most power at the operating point
    std::vector<std::string> sources;  ///< names of the sources that deliver power
    std::vector<BlockCost> blocks;     ///< in netlist order
    std::vector<std::pair<std::string, PowerBreakdown>> power;  ///< "op"; for a transient also "mean", "peak" and the phases of its force
    bool has_sensor = false;                                    ///< false: there is no sensor, and its power is 0
    bool is_afferent = false;                                   ///< true if the circuit has a force input and a spike output
    std::size_t unknown_areas = 0;  ///< number of elements of unknown area: resistors, inductors, diodes, capacitors with an expression
    double smallest_bias = 0;       ///< A: smallest current of an ideal bias source; 0 if there is none
    /// Transistors that are off and leak more than a tenth of smallest_bias: those at nodes whose voltage a capacitor holds, then the
    /// others, both by current.
    std::vector<Leakage> leaks;
    std::vector<std::string> leaking_names;  ///< names of the transistors of `leaks`, in the same order

    Area area() const;                                         ///< of all blocks together
    const PowerBreakdown* powers(std::string_view key) const;  ///< the entry of `power` with this name; null if there is none
    double per_mm2() const { return 1e-6 / area().total(); }   ///< number of these circuits on 1 mm^2
};

/// The cost of a circuit with its present parameter values and variation. `over` holds the power over a transient; null: there was none.
Result<Cost> cost_of(AnalysisContext&, const PowerOverTime* over = nullptr);

}  // namespace corpuscle::circuit
