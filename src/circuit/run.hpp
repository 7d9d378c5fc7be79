#pragma once
// A netlist's own orders, carried out: its analyses, in the order in which they stand, then its measures and what it expects.

#include "circuit/analysis/bench.hpp"

namespace corpuscle::circuit {

/// One analysis and what it found.
struct Analysed {
    const Command* command;  ///< of the circuit
    Findings findings;
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

    std::vector<Plot> plots() const;  ///< of all analyses, with what is swept and what is saved
};

/// `stop` is asked now and then, told what is at work and how far it is.
using RunStop = std::function<bool(std::string_view word, double share)>;
Result<RunOutcome> run(TestBench&, const RunStop& stop = {});
Result<RunOutcome> run(std::shared_ptr<const Circuit>, const RunStop& stop = {});

/// .print lines of an analysis, as columns for people; "" if there are none.
std::string printed(const Circuit&, const Analysed&);

}  // namespace corpuscle::circuit
