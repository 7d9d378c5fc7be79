#pragma once
// The text of an optimization file, and the text of the sweep that simulates its designs. The sweep checks names, units and bounds. Used
// inside src/optimize only.

#include "optimize/problem.hpp"

namespace corpuscle::optimize {

/// An optimization file. All its keys are known, and their values are of the right kind.
struct ProblemText {
    ConfigNode top;                               ///< the outermost table; its location names the file
    std::vector<std::vector<LocatedText>> names;  ///< of each [[variable]]
    /// For each [[at]]: the value that [chips] gives, which is then the last one of the axis; otherwise not a scalar.
    std::vector<ConfigNode> chip_settings;
    std::size_t chips = 0;  ///< number of chips
    double required_yield = 1;
    DesignGoal goal;          ///< without column and unit
    sweeps::SweepText sweep;  ///< its axes are the names of all variables with their bounds as values, then the conditions

    const std::string& file() const { return top.location.file; }
    std::span<const ConfigNode> variables() const { return top.elements_of("variable"); }
    std::span<const ConfigNode> conditions() const { return top.elements_of("at"); }
};

/// `canonical`: see SweepText.
Result<ProblemText> interpret_text(ConfigNode top, std::string canonical);

/// The value of a key that is true or false; false if it is missing.
Result<bool> flag_of(const ConfigNode& table, std::string_view key);

// The parts of a problem, read when its sweep is ready.
Result<std::vector<DesignVariable>> read_variables(const ProblemText&, const sweeps::PlannedSweep&);
/// The conditions, then the chips.
Result<std::vector<DesignCase>> make_cases(const ProblemText&, const sweeps::SweepPlan&);

}  // namespace corpuscle::optimize
