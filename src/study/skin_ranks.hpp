#pragma once
// A skin distributed over MPI ranks. Each rank has a range of the afferents of every class and computes the force itself. Rank 0 gathers
// the spikes block by block and writes the files.

#include "study/skin_run.hpp"
#include "study/sweep/ranks.hpp"

namespace corpuscle {

/// For rank 0: simulates its own afferents and gathers the spikes of the other ranks. Returns the error of any rank.
std::unique_ptr<SkinSimulator> distributed_skin_simulator(Ranks&, Skin& own, ThreadPool&);
/// For rank 0, at the end of the run or after an error: makes the other ranks end.
void shut_down_skin_workers(Ranks&);
/// For all other ranks: simulates until the force ends or rank 0 shuts the run down.
Result<void> run_skin_worker(Ranks&, Result<SkinForce*>, Skin*, ThreadPool&);

}  // namespace corpuscle
