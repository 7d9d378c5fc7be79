#include "sweep/parallel/rank_run.hpp"

#include <chrono>
#include <thread>

#include "core/bytes.hpp"

namespace corpuscle {
namespace {

/// Everything that must be equal in all ranks of a sweep.
std::string identity_of(const Sweep& sweep) {
    ByteWriter out;
    out.put(sweep.item_count);
    for (const auto& entry : sweep.metadata) out.put(entry.name, entry.text);
    return out.take();
}

/// The message that starts a worker: the identity of the sweep, and the ranges of items that have no row in the results.
std::string start_message(const Sweep& sweep, const std::vector<ItemQueue::Range>& missing) {
    ByteWriter out;
    out.put(identity_of(sweep), missing);
    return out.take();
}

/// The ranges of missing items in a start message. Returns an error if its sweep is not this one.
Result<std::vector<ItemQueue::Range>> read_start(const Sweep& sweep, std::string_view message) {
    ByteReader in(message);
    std::string identity;
    std::vector<ItemQueue::Range> missing;
    if (!in.get(identity) || identity != identity_of(sweep) || !in.get(missing))
        return bad_input("reads another sweep than rank 0: give all ranks the same files");
    return missing;
}

ItemQueue items_of_rank(const Ranks& ranks, std::vector<ItemQueue::Range> missing, const SweepRunOptions& run) {
    return {std::move(missing), run.shard, Shard{ranks.rank(), ranks.size()}};
}

/// The workers, as rank 0 sees them.
class SweepWorkers {
    static constexpr std::size_t max_bytes = std::size_t{32} << 20;  // of the messages in one call of gather()
    Ranks& ranks_;
    int running_;  // number of workers that have not finished; the last message of a worker is empty

public:
    SweepWorkers(Ranks& ranks, const std::string& start) : ranks_(ranks), running_(ranks.size() - 1) {
        for (int rank = 1; rank < ranks.size(); ++rank) ranks.send(rank, start);
    }
    bool have_finished() const { return running_ == 0; }

    /// Appends the outcomes that have arrived. Returns the error of a worker, if it had one.
    Result<void> gather(std::vector<ItemOutcome>& outcomes) {
        for (std::size_t bytes = 0; bytes < max_bytes;) {
            auto received = ranks_.receive_any();
            if (!received) break;
            if (!received->message) return received->message.error();
            bytes += received->message->size();
            if (received->message->empty()) --running_;
            if (!unpack_outcomes(*received->message, outcomes))
                return bad_input("ranks run different versions of corpuscle: install the same one on all machines");
        }
        return {};
    }
};

}  // namespace

Result<void> run_coordinator(Ranks& ranks, const Sweep& sweep, SweepResults& results, const SweepRunOptions& run, SweepProgress& progress) {
    const auto missing = TRY(results.missing_ranges());
    progress = {.planned = ItemQueue(missing, run.shard).remaining()};
    results.announce_run(progress.planned);
    SweepWorkers workers(ranks, start_message(sweep, missing));
    const auto write = [&](std::vector<ItemOutcome>&& outcomes) {
        const auto gathered = workers.gather(outcomes);
        const auto written = write_outcomes(sweep, results, run, progress, std::move(outcomes));
        return gathered ? written : gathered;
    };
    auto ok = compute_items(sweep, items_of_rank(ranks, missing, run), run, write);
    while (ok && !workers.have_finished()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        ok = write({});
        if (ok && run.should_stop()) ok = Error{ErrorCode::interrupted, "interrupted"};
    }
    return ok;
}

void run_worker(Ranks& ranks, const Result<std::unique_ptr<Sweep>>& sweep, const SweepRunOptions& run) {
    const auto ok = [&]() -> Result<void> {
        const auto start = TRY(ranks.receive(0));  // also if there is no sweep: rank 0 receives nothing before it has sent this
        if (!sweep) return sweep.error();
        auto missing = TRY(read_start(**sweep, start));
        return compute_items(**sweep, items_of_rank(ranks, std::move(missing), run), run, [&](std::vector<ItemOutcome>&& outcomes) {
            if (!outcomes.empty()) ranks.send(0, pack_outcomes(outcomes));
            return Result<void>();
        });
    }();
    ok ? ranks.send(0, "") : ranks.send_error(ok.error());
}

auto byte_fields(ItemOutcome& o) {
    return std::tie(o.item, o.end, o.reason, o.measures, o.spikes, o.probes, o.steps, o.iterations, o.ran_alone);
}

std::string pack_outcomes(const std::vector<ItemOutcome>& outcomes) {
    ByteWriter out;
    for (const auto& o : outcomes) out.put(o);
    return out.take();
}

bool unpack_outcomes(std::string_view message, std::vector<ItemOutcome>& outcomes) {
    for (ByteReader in(message); !in.ended();)
        if (auto& o = outcomes.emplace_back(); !in.get(o) || o.end > ItemEnd::diverged) return outcomes.pop_back(), false;
    return true;
}

}  // namespace corpuscle
