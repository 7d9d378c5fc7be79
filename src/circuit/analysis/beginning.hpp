#pragma once
// Where a transient begins.

#include "circuit/analysis/bench.hpp"

namespace corpuscle::circuit {

struct Beginning {
    std::vector<double> x;
    bool settled = true;            ///< false (uic): only charges are as they should be, the rest follows from them
    std::vector<double> charge{};   ///< what ic= of elements adds to the charges at x, of each unknown's equation; empty: nothing
    std::optional<Error> remark{};  ///< a warning: it would have stayed where it rests
};

/// The operating point, sought from `from`, with the nodes of .ic held there; with uic those alone, all else at 0 V, capacitors with
/// ic= charged to that voltage and inductors with ic= carrying that current. A circuit without
/// .ic that rests where the smallest disturbance would grow begins 10 mV beside, in the direction that grows most.
Result<Beginning> beginning(TestBench&, bool uic, std::vector<double> from = {});

}  // namespace corpuscle::circuit
