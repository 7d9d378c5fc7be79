#pragma once
// Runs the directives of a netlist: its analyses in order, then its measurements and expectations.

#include <functional>
#include <optional>

#include "circuit/analysis/analysis_context.hpp"

namespace corpuscle::circuit {

/// One analysis and its result.
struct AnalysisRun {
    const Directive* directive;  ///< points into the circuit
    AnalysisResult result;
    std::size_t point_count = 0;  ///< in the first plot
    std::string printed_tables;   ///< the tables of .print
    Plot last_point;              ///< the last point of a transient, stored even if RunOptions::keep_points is false
};

/// One .expect and whether it is met.
struct Expectation {
    std::string name;
    double expected, tolerance, actual;
    bool is_met;
    SourceLocation location;
};

/// The results of a run.
struct RunOutcome {
    std::vector<AnalysisRun> analyses;
    std::vector<std::pair<std::string, double>> numbers;  ///< of analyses and .meas, in order; a measurement that found nothing is NaN
    std::vector<Expectation> expectations;
    std::vector<Error> warnings;

    std::vector<std::string> saved_curves;  ///< names in .save: v(a), v(a,b), i(v1) ... An empty list means all.

    /// The value of a name after the run: a measurement or a number of an analysis. Otherwise the value of a curve, such as "v(out)", at
    /// the last point of the first plot that has it.
    std::optional<double> find_number(std::string_view name) const;
    std::vector<Plot> plots(const AnalysisRun&) const;  ///< the swept quantity and the saved curves
    std::vector<Plot> plots() const;                    ///< of all analyses
};

/// Receives the saved curves during the run: a transient point by point, other analyses as complete plots.
class CurveSink : public PointSink {
public:
    virtual Result<void> add_plots(std::span<const Plot>) = 0;
};

/// Options of run_directives().
struct RunOptions {
    std::function<bool(std::string_view analysis, double progress)>
        should_stop{};  ///< called now and then with the analysis and its progress (0 to 1); true stops the run
    CurveSink* curve_sink = nullptr;
    PointSink* unknowns_sink = nullptr;  ///< receives all unknowns at each time point of a transient
    bool keep_points = true;             ///< keep the points of a transient in memory, as a plot of its result
    bool print_tables = true;            ///< make the tables of .print
};
/// Runs all directives. A directive that is wrong, or an analysis that fails, is an error. An .expect that is not met is not an error.
Result<RunOutcome> run_directives(AnalysisContext&, const RunOptions& = {});
Result<RunOutcome> run_directives(std::shared_ptr<const Circuit>, const RunOptions& = {});

}  // namespace corpuscle::circuit
