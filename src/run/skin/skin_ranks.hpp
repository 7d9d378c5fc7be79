#pragma once
// A skin distributed over MPI ranks. Each rank simulates a part of the afferents of every class, and computes the force on the skin itself.
// Rank 0 (the coordinator) gathers the spikes of the other ranks (the workers) block by block and writes the files.

#include "run/ranks.hpp"
#include "run/skin/skin_force.hpp"

namespace corpuscle {

/// For rank 0: adds the spikes of all workers for one block to its own, and sorts them. Returns the error of a worker, if it had one.
Result<void> gather_spikes(Ranks&, std::vector<Spike>&);
/// For rank 0, after the last block: adds the workers' statistics to its own.
Result<void> gather_stats(Ranks&, SkinStats&);
/// For a worker: simulates until the force ends, and sends everything to rank 0. `force`: the force, or the error that prevented its
/// preparation, in which case `skin` may be null.
void run_skin_worker(Ranks&, Result<SkinForce*> force, Skin* skin, ThreadPool&);

}  // namespace corpuscle
