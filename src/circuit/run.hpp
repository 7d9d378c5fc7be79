#pragma once
// Runs the directives of a netlist: its analyses in order, then its measurements and expectations.

#include <functional>
#include <optional>

#include "circuit/analysis/bench.hpp"

namespace corpuscle::circuit {

/// One analysis and its result.
struct Analysed {
    const Command* command;  ///< of the circuit
    Findings findings;
    std::size_t points = 0;  ///< in the first plot
    std::string printed;     ///< the tables of .print
    Plot last;               ///< the last point of a transient, whose points may not have been kept
};

/// One .expect and whether it is met.
struct Expectation {
    std::string what;
    double expected, tolerance, found;
    bool held;
    SourceLocation place;
};

/// The results of a run.
struct RunOutcome {
    std::vector<Analysed> analyses;
    std::vector<std::pair<std::string, double>> numbers;  ///< in order; a measurement that found nothing is NaN
    std::vector<Expectation> expectations;
    std::vector<Error> remarks;

    std::vector<std::string> saved;  ///< names in .save: v(a), v(a,b), i(v1) ... An empty list means all.

    /// The value of a name after the run: a measurement or a number of an analysis. Otherwise the value of a curve, such as "v(out)", at
    /// the last point of the first plot that has it.
    std::optional<double> number(std::string_view name) const;
    std::vector<Plot> plots(const Analysed&) const;  ///< the swept quantity and the saved curves
    std::vector<Plot> plots() const;                 ///< of all analyses
};

/// Receives the saved curves during the run: a transient point by point, other analyses as complete plots.
class CurveSink : public PointSink {
public:
    virtual Result<void> whole(std::span<const Plot>) = 0;
};

/// Options of run_directives().
struct RunOrders {
    std::function<bool(std::string_view analysis, double progress)>
        stop{};  ///< called now and then with the analysis and its progress (0 to 1); true stops the run
    CurveSink* curves = nullptr;
    PointSink* unknowns = nullptr;  ///< receives all unknowns at each time point of a transient
    bool keep = true;               ///< keep the points of a transient in memory, as a plot of its result
    bool print = true;              ///< make the tables of .print
};
/// Runs all directives. A directive that is wrong, or an analysis that fails, is an error. An .expect that is not met is not an error.
Result<RunOutcome> run(TestBench&, const RunOrders& = {});
Result<RunOutcome> run(std::shared_ptr<const Circuit>, const RunOrders& = {});

}  // namespace corpuscle::circuit
