#include "reproduction/thesis/chip_runs.hpp"

#include <mutex>

#include "core/thread_pool.hpp"

namespace corpuscle {
namespace {

using circuit::Chip;
using circuit::ChipResponse;

/// Hands out the chips, each to one thread, and collects their responses.
class ChipQueue {
    const std::vector<Chip>& chips_;
    const std::function<bool(std::size_t)>& progress_;
    std::mutex mutex_;  // protects the members below
    std::size_t next_ = 0, finished_ = 0;
    bool stopped_ = false;
    std::vector<ChipResponse> responses_;

public:
    ChipQueue(const std::vector<Chip>& chips, const std::function<bool(std::size_t)>& progress)
        : chips_(chips), progress_(progress), responses_(chips.size()) {}

    std::optional<Chip> next() {
        const std::lock_guard lock(mutex_);
        if (stopped_ || next_ == chips_.size()) return {};
        return chips_[next_++];
    }
    void take(const Chip& chip, ChipResponse&& response) {
        const std::lock_guard lock(mutex_);
        responses_[static_cast<std::size_t>(chip.id)] = std::move(response);
        stopped_ = stopped_ || !progress_(++finished_);
    }
    /// The responses, in the order of the chips.
    Result<std::vector<ChipResponse>> result() {
        if (stopped_) return interrupted_error();
        return std::move(responses_);
    }
};

}  // namespace

Result<std::vector<ChipResponse>> run_all_chips(std::vector<Chip> chips, const std::function<bool(std::size_t)>& progress) {
    if (chips.empty()) return std::vector<ChipResponse>();
    for (std::size_t k = 0; k < chips.size(); ++k) chips[k].id = static_cast<std::int64_t>(k);
    ChipQueue queue(chips, progress);
    std::mutex mutex;
    std::optional<Error> failed;
    ThreadPool pool;
    pool.for_each(pool.threads(), [&](std::size_t, unsigned) {
        // The first design stands for all designs, which have the same devices.
        const auto done = circuit::run_chips(
            chips[0].design, [&] { return queue.next(); },
            [&](const Chip& at, ChipResponse&& response) { queue.take(at, std::move(response)); }, {});
        const std::lock_guard lock(mutex);
        if (!done) failed = done.error();
    });
    return failed ? *failed : queue.result();
}

}  // namespace corpuscle
