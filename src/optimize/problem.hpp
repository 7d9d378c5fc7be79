#pragma once
// An optimization: the variables of a design, the cases in which it must work, its goal and its limits. A file defines it
// (doc/optimize.md).

#include "sweep/subject/firing_limits.hpp"
#include "sweep/subject/subject.hpp"

namespace corpuscle::optimize {

/// A quantity of the netlist that the search changes.
struct DesignVariable {
    std::vector<std::string> names;  ///< that all get the value: "i_biasf", or "rect.p1b.m" and "rect.n2b.m"
    std::string unit;                ///< of the numbers below
    double min = 0, max = 0;
    double start = 0;  ///< the value before the optimization
    bool is_logarithmic = false, is_integer = false;

    std::string name() const { return names[0]; }
    /// The value at a position from 0 (min) to 1 (max). An integer is rounded.
    double value(double position) const;
    double position(double value) const;
};

/// One simulation of a design: a condition (corner, temperature, supply ...) with the nominal chip, or one of the chips.
struct DesignCase {
    std::vector<double> values = {};         ///< of the conditions' axes
    std::optional<std::uint64_t> chip = {};  ///< number of the chip; no value: the nominal one
    std::string text = {};                   ///< "corner=ss temp=-20 supply=600 mV", "chip 3", "the only condition"
};

/// The number that the search minimizes or maximizes.
struct DesignGoal {
    enum class Kind {
        none,      ///< only the limits count
        measure,   ///< a measure of the simulation
        distance,  ///< of the spikes from the pattern, see FiringLimits::distance()
        yield      ///< fraction of the chips that are within the limits
    } kind = Kind::none;
    /// The cases that count: the first one, the mean of all conditions, or that with the largest value (smallest, if it is maximized).
    enum class Over { first, mean, worst } over = Over::first;
    std::string name, unit = {};
    std::size_t column = 0;  ///< of the measure
    bool is_maximized = false;
};

struct SearchSettings {
    std::size_t points = 64;        ///< quasi-random designs, of which the best begin a local search
    std::size_t starts = 4;         ///< local searches, of which one begins at the present design
    std::size_t evaluations = 150;  ///< most designs of one local search
    std::size_t rounds = 4;         ///< most rounds of local searches; after each, its designs are simulated in all cases
    std::size_t cases = 16;         ///< cases with which the search begins: those in which the present design is nearest to its limits
};

struct OptimizationProblem {
    std::string title, file;
    std::string subject;                          ///< name of the afferent or netlist
    std::unique_ptr<sweeps::PlannedSweep> sweep;  ///< simulates the designs; its axes are the variables, then the conditions
    std::vector<DesignVariable> variables;
    std::size_t condition_count = 0;  ///< the first ones of `cases`; the others are chips
    std::vector<DesignCase> cases;
    double required_yield = 1;            ///< fraction of the chips that must be within the limits
    std::optional<FiringLimits> pattern;  ///< of the spikes
    bool pattern_is_nominal = false;      ///< the pattern is a limit of the first condition and of the chips; false: of all cases
    std::vector<bool>
        is_nominal_limit;  ///< of each measure of the sweep: its limits, too, are those of the first condition and of the chips
    DesignGoal goal;
    SearchSettings search;
    std::uint64_t seed = 0;

    /// True for the first condition and the chips.
    bool is_nominal(std::size_t number) const { return number == 0 || number >= condition_count; }
    bool has_pattern(std::size_t number) const { return pattern && (!pattern_is_nominal || is_nominal(number)); }
    std::size_t chip_count() const { return cases.size() - condition_count; }
    std::vector<double> start() const;
    /// The values of all axes for a design in a case.
    std::vector<double> axis_values(std::span<const double> design, const DesignCase&) const;
};

/// Settings of the command line, which replace those of the file.
struct OptimizationOverrides {
    std::optional<std::uint64_t> seed = {};
};

/// Reads an optimization file (.toml).
Result<OptimizationProblem> read_problem(const std::string& path, const OptimizationOverrides& = {});
/// Reads the text of an optimization file. `name`: for messages; the paths in the text are relative to its folder.
Result<OptimizationProblem> read_problem_text(const std::string& text, const std::string& name, const OptimizationOverrides& = {});

/// The number of variables is limited, so that the reader stays quick on any file.
inline constexpr std::size_t max_variables = 24, max_cases = 20'000;

}  // namespace corpuscle::optimize
