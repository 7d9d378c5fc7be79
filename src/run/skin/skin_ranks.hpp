#pragma once
// A skin distributed over MPI ranks. Each rank simulates a part of the afferents of every class, and computes the force on the skin itself.
// Rank 0 (the coordinator) gathers the spikes of the other ranks (the workers) block by block and writes the files.

#include "run/ranks.hpp"
#include "run/skin/skin_run.hpp"

namespace corpuscle {

/// For rank 0: simulates its own afferents with the skin `own` and gathers the spikes of the other ranks. An error of any rank is returned
/// by respond() or flush() of the simulator.
std::unique_ptr<SkinSimulator> distributed_skin_simulator(Ranks&, Skin& own, ThreadPool&);
/// For rank 0, at the end of the run or after an error: tells the other ranks to end, and ends the communication.
void shut_down_skin_workers(Ranks&);
/// For all other ranks: simulates until the force ends or rank 0 shuts the run down. `force`: the force, or the error that prevented its
/// preparation, in which case `skin` may be null. Errors are sent to rank 0 and not returned.
Result<void> run_skin_worker(Ranks&, Result<SkinForce*> force, Skin* skin, ThreadPool&);

}  // namespace corpuscle
