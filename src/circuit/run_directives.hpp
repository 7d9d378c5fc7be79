#pragma once
// Runs the directives of a netlist: its analyses in order, then its measurements and expectations.

#include "circuit/analysis/analysis_context.hpp"
#include "circuit/measure/fourier.hpp"

namespace corpuscle::circuit {

/// One analysis and its result.
struct AnalysisRun {
    const Directive* directive;  ///< points into the circuit
    AnalysisResult result;
    std::size_t point_count = 0;           ///< number of points of the first plot, even of points that are not kept
    std::string printed_tables;            ///< the tables of .print
    std::vector<FourierSpectrum> spectra;  ///< of .four, for the first .tran
    Plot last_point;                       ///< of the first plot; stored even if RunOptions::keep_points is false
};

/// One .expect and whether it is met.
struct Expectation {
    std::string name;
    double expected, tolerance, actual;  ///< `tolerance` is absolute, in the unit of the value
    bool is_met;
    SourceLocation location;
};

/// The results of a run.
struct RunOutcome {
    std::vector<AnalysisRun> analyses;
    std::vector<std::pair<std::string, double>> numbers;  ///< named numbers of analyses, of .four, then of .meas; NaN: nothing was found
    std::vector<Expectation> expectations;
    std::vector<Error> warnings;
    std::vector<Error> left_out;  ///< the reason for each .meas, or curve of .four, that is left out; `warnings` has them, too

    std::vector<std::string> saved_curves;  ///< names of the curves to save: v(a), v(a,b), i(v1) ... An empty list means all curves.

    /// The number of this name: a number of an analysis or a measurement. If there is none, the value of the curve of this name, such as
    /// "v(out)", at the last point of the first plot that has it.
    std::optional<double> find_number(std::string_view name) const;
    std::vector<Plot> plots(const AnalysisRun&) const;  ///< the plots of one analysis, with the swept quantity and the saved curves
    std::vector<Plot> plots() const;                    ///< the same of all analyses
};

/// Options of run_directives().
struct RunOptions {
    std::function<bool(std::string_view analysis, double progress)>
        should_stop{};  ///< called repeatedly with the name of the analysis and its progress (0 to 1); returns true to stop the run
    PointSink* curve_sink = nullptr;     ///< receives the saved curves of all plots during the run
    PointSink* unknowns_sink = nullptr;  ///< receives time, all unknowns and the saved device currents at each time point of a transient
    bool keep_points = true;             ///< keep the points of a transient in memory, as a plot of its result
    bool print_tables = true;            ///< make the tables of .print, AnalysisRun::printed_tables
};
/// Runs all directives. An invalid directive and a failed analysis are errors. An .expect that is not met is not an error.
Result<RunOutcome> run_directives(AnalysisContext&, const RunOptions& = {});
Result<RunOutcome> run_directives(std::shared_ptr<const Circuit>, const RunOptions& = {});

}  // namespace corpuscle::circuit
