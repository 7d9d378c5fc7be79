#pragma once
// The queue of unfinished work items, handed out in blocks.

#include <cstdint>
#include <utility>
#include <vector>

namespace corpuscle {

/// The part of a sweep to run here: items k with k % shard_count == index.
struct Shard {
    std::int64_t index = 0, shard_count = 1;

    bool contains(std::int64_t item) const { return item % shard_count == index; }
    /// Number of items in [from, to).
    std::int64_t count(std::int64_t from, std::int64_t to) const { return count_before(to) - count_before(from); }

private:
    std::int64_t count_before(std::int64_t item) const { return (item + shard_count - 1 - index) / shard_count; }
};

class ItemQueue {
public:
    using Range = std::pair<std::int64_t, std::int64_t>;  ///< [first, second)

    ItemQueue(std::vector<Range> missing, Shard shard) : ranges_(std::move(missing)), shard_(shard) {
        for (const auto& [from, to] : ranges_) remaining_ += shard_.count(from, to);
    }

    /// The next items, in order, at most `max`; returned items come first.
    std::vector<std::int64_t> take(std::int64_t max);
    /// Returns items to the queue.
    void put_back(const std::vector<std::int64_t>& items) {
        returned_.insert(returned_.end(), items.begin(), items.end());
        remaining_ += static_cast<std::int64_t>(items.size());
    }
    std::int64_t remaining() const { return remaining_; }

private:
    std::vector<Range> ranges_;
    std::vector<std::int64_t> returned_;
    std::size_t at_ = 0;  // index of the first range with items left
    Shard shard_;
    std::int64_t remaining_ = 0;
};

}  // namespace corpuscle
