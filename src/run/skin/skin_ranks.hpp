#pragma once
// A skin distributed over MPI ranks. Each rank simulates a part of the afferents of every class, and computes the force on the skin itself.
// Rank 0 (the coordinator) gathers the spikes of the other ranks (the workers) block by block and writes the files.

#include <deque>

#include "run/ranks.hpp"
#include "run/skin/skin_force.hpp"

namespace corpuscle {

/// The workers, as rank 0 sees them. An error of any of them is returned by gather() or finish().
class SkinWorkers {
    Ranks& ranks_;
    std::vector<std::deque<std::string>> received_;  // messages of each rank that were received but not yet read

    Result<std::string> next_from(int rank);

public:
    explicit SkinWorkers(Ranks& ranks) : ranks_(ranks), received_(static_cast<std::size_t>(ranks.size())) {}
    /// Adds the spikes of all workers for one block to those of rank 0, and sorts them.
    Result<void> gather(std::vector<Spike>&);
    /// At the end of the force: as gather(), for the spikes that are still being conducted; and adds the workers' statistics to those of
    /// rank 0.
    Result<void> finish(std::vector<Spike>&, SkinStats&);
};

/// For rank 0, at the end of the run or after an error: tells the other ranks to end, and ends the communication.
void shut_down_skin_workers(Ranks&);
/// For all other ranks: simulates until the force ends or rank 0 shuts the run down. `force`: the force, or the error that prevented its
/// preparation, in which case `skin` may be null. Errors are sent to rank 0 and not returned.
void run_skin_worker(Ranks&, Result<SkinForce*> force, Skin* skin, ThreadPool&);

}  // namespace corpuscle
