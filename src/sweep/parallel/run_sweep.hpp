#pragma once
// Runs the items of a sweep, on threads and on MPI ranks, and writes the outcomes to its results file. The missing items are dealt out to
// the ranks once, at the start: with three ranks, rank 1 computes the second, fifth, eighth ... of them. Rank 0 also receives the outcomes
// of the other ranks, the workers, and writes all to the results file.

#include "run/ranks.hpp"
#include "sweep/store/sweep_results.hpp"

namespace corpuscle {

/// The part of a sweep that one process computes: the items k with k % shard_count == index.
struct Shard {
    std::int64_t index = 0, shard_count = 1;  ///< index counts from 0

    bool contains(std::int64_t item) const { return item % shard_count == index; }
    /// Number of this shard's items in [from, to).
    std::int64_t count(std::int64_t from, std::int64_t to) const { return count_before(to) - count_before(from); }

private:
    /// Number of this shard's items below `item`.
    std::int64_t count_before(std::int64_t item) const { return (item + shard_count - 1 - index) / shard_count; }
};

class ItemQueue {
public:
    using Range = std::pair<std::int64_t, std::int64_t>;  ///< items in [first, second)

    /// The items of the shard in the ranges `missing`. `part`: only these of them, counted in ascending order, so that the parts have equal
    /// numbers of items.
    ItemQueue(std::vector<Range> missing, Shard shard, Shard part = {}) : ranges_(std::move(missing)), shard_(shard), part_(part) {
        std::int64_t items = 0;
        for (const auto& [from, to] : ranges_) items += shard_.count(from, to);
        remaining_ = part_.count(0, items);
    }

    /// Removes and returns at most `max` items, in ascending order.
    std::vector<std::int64_t> take(std::int64_t max);
    std::int64_t remaining() const { return remaining_; }  ///< number of items in the queue

private:
    std::vector<Range> ranges_;  // [first item not yet taken, end)
    std::size_t at_ = 0;         // index of the first range with items left
    Shard shard_, part_;
    std::int64_t passed_ = 0;  // number of items of the shard that were taken or belong to other parts
    std::int64_t remaining_ = 0;
};

/// Progress of one run of a sweep, which computes the items that the results file does not have yet.
struct SweepProgress {
    std::int64_t planned = 0;  ///< items to compute: those of the shard that had no row in the results at the start
    std::int64_t done = 0, iteration_limit = 0, diverged = 0;  ///< finished items, by how they ended
    std::int64_t steps = 0, iterations = 0, spikes = 0;        ///< sums over the finished items, see ItemOutcome
    std::int64_t ran_alone = 0;                                ///< number of items, see ItemOutcome

    std::int64_t finished() const { return done + iteration_limit + diverged; }
    void add(const ItemOutcome&);
};

struct SweepRunOptions {
    unsigned threads = 0;  ///< 0: one for each core
    Shard shard = {};
    double write_interval = 0.2;  ///< s between two writes to the results; a program that is killed loses the outcomes since the last one
    std::function<bool()> should_stop = [] { return false; };                             ///< called after each write; true stops the run
    std::function<void(const SweepProgress&)> on_progress = [](const SweepProgress&) {};  ///< called after each write
};

/// Runs the items of the shard that have no row in the results. Returns when all are finished, when stopped (error `interrupted`), or on an
/// error in the sweep or in writing. All finished items are then in the results, unless writing failed. Updates `progress` during the run.
/// `ranks`: for rank 0, which also returns the first error of a worker; null: this process runs all items.
Result<void> run_sweep(const Sweep&, SweepResults&, const SweepRunOptions&, SweepProgress& progress, Ranks* ranks = nullptr);
/// For a worker: computes its items and sends the outcomes to rank 0, or the error that prevents this. `sweep`: may be an error, too.
void run_worker(Ranks&, const Result<std::unique_ptr<Sweep>>& sweep, const SweepRunOptions&);

std::string pack_outcomes(const std::vector<ItemOutcome>&);
/// Appends the outcomes of a message. Returns false if it is incomplete.
bool unpack_outcomes(std::string_view message, std::vector<ItemOutcome>&);

}  // namespace corpuscle
