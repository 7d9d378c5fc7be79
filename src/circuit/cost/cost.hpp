#pragma once
// The cost of a circuit: power, area, leakage.

#include <nlohmann/json_fwd.hpp>

#include "circuit/cost/area.hpp"
#include "circuit/cost/power.hpp"
#include "circuit/run_directives.hpp"

namespace corpuscle::circuit {

/// Leakage of one transistor: the drain current, junction included, with the gate at the source and the supply voltage between drain
/// and source. The bulk is at the source, or as far forward-biased as at the operating point.
struct Leakage {
    std::size_t element = 0;  ///< index in Circuit::elements
    std::string name;         ///< of the transistor
    double current = 0;       ///< A
    /// V, at the operating point, positive towards conduction. The source is the terminal that acts as source there.
    double V_GS = 0;
    bool is_off = false;         ///< true if V_GS is below phi_t: the transistor carries less than e times its leakage current
    std::string capacitor_node;  ///< a node at its source or drain whose voltage a capacitor holds, such as "u"; "" if there is none
};

/// Area and leakage of one block.
struct BlockCost {
    std::string name;
    std::size_t transistors = 0;       ///< number of MOS transistors; an array counts as one
    std::size_t unit_transistors = 0;  ///< number of unit transistors that these consist of
    Area area;
    Leakage worst_leak;  ///< of the transistor with the largest leakage current; its name is "" if the block has no UICM transistor
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

    Area area() const;                                         ///< of all blocks together
    const PowerBreakdown* powers(std::string_view key) const;  ///< the entry of `power` with this name; null if there is none
    double per_mm2() const { return 1e-6 / area().total(); }   ///< number of these circuits on 1 mm^2
};

/// The area of all elements. Elements of unknown area (see Cost) are left out.
Area area_of(const Circuit&);

/// The cost of a circuit with its present parameter values and variation. `over` holds the power over a transient; null: there was none.
Result<Cost> cost_of(AnalysisContext&, const PowerOverTime* over = nullptr);

nlohmann::ordered_json document_of(const Cost&);

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
