#pragma once
// A netlist's own orders, carried out: its analyses, in the order in which they stand, then its measures and what it expects.

#include <functional>
#include <optional>

#include "circuit/analysis/bench.hpp"

namespace corpuscle::circuit {

/// One analysis and what it found.
struct Analysed {
    const Command* command;  ///< of the circuit
    Findings findings;
    std::size_t points = 0;  ///< of its first plot
    std::string printed;     ///< what .print asks of it, as columns for people
    Plot last;               ///< of a transient, whose points may not have been kept: its last one
};

/// One .expect: held or not.
struct Expectation {
    std::string what;
    double expected, tolerance, found;
    bool held;
    Place place;
};

struct RunOutcome {
    std::vector<Analysed> analyses;
    std::vector<std::pair<std::string, double>> numbers;  ///< in order; a measure that found nothing is NaN
    std::vector<Expectation> expectations;
    std::vector<Error> remarks;

    std::vector<std::string> saved;  ///< by .save: v(a), v(a,b), i(v1) ...; empty: everything

    /// What a name means once all is done: a measure or a number of an analysis; else a curve, "v(out)", at the last point of the first
    /// plot that has it.
    std::optional<double> number(std::string_view name) const;
    std::vector<Plot> plots(const Analysed&) const;  ///< with what is swept and what is saved
    std::vector<Plot> plots() const;                 ///< of all analyses
};

/// Takes what is saved of each analysis, as it is found: of a transient its points as they come, of others their plots.
class CurveSink : public PointSink {
public:
    virtual Result<void> whole(std::span<const Plot>) = 0;
};

/// How a run is wanted.
struct RunOrders {
    std::function<bool(std::string_view word, double share)> stop{};  ///< asked now and then, told what is at work and how far it is
    CurveSink* curves = nullptr;
    PointSink* unknowns = nullptr;  ///< sees a transient's points, all unknowns of each
    bool keep = true;               ///< a transient's points stay in memory, as a plot of its findings
    bool print = true;              ///< columns are made for .print
};
Result<RunOutcome> run(TestBench&, const RunOrders& = {});
Result<RunOutcome> run(std::shared_ptr<const Circuit>, const RunOrders& = {});

}  // namespace corpuscle::circuit
