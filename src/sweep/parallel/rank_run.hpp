#pragma once
// Runs a sweep on MPI ranks. The missing items are dealt out to the ranks once, at the start: with three ranks, rank 1 computes the second,
// fifth, eighth ... of them. Rank 0 also receives the outcomes of the other ranks, the workers, and writes all to the results file.

#include "run/ranks.hpp"
#include "sweep/parallel/run_sweep.hpp"
#include "sweep/spec/sweep.hpp"

namespace corpuscle {

/// For rank 0: like run_sweep(), on all ranks. Also returns the first error of a worker.
Result<void> run_coordinator(Ranks&, const Sweep&, SweepResults&, const SweepRunOptions&, SweepProgress&);
/// For a worker: computes its items and sends the outcomes to rank 0, or the error that prevents this. `sweep`: may be an error, too.
void run_worker(Ranks&, const Result<std::unique_ptr<Sweep>>& sweep, const SweepRunOptions&);

std::string pack_outcomes(const std::vector<ItemOutcome>&);
/// Appends the outcomes of a message. Returns false if it is incomplete.
bool unpack_outcomes(std::string_view message, std::vector<ItemOutcome>&);

}  // namespace corpuscle
