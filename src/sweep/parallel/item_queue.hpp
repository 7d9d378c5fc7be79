#pragma once
// The queue of work items that are still to be computed. They are handed out many at a time.

#include <cstdint>
#include <utility>
#include <vector>

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

    /// The items of the shard in the ranges `missing`.
    ItemQueue(std::vector<Range> missing, Shard shard) : ranges_(std::move(missing)), shard_(shard) {
        for (const auto& [from, to] : ranges_) remaining_ += shard_.count(from, to);
    }

    /// Removes and returns at most `max` items: first those that were put back, then the others in ascending order.
    std::vector<std::int64_t> take(std::int64_t max);
    /// Puts back items that were taken but not computed.
    void put_back(const std::vector<std::int64_t>& items) {
        put_back_.insert(put_back_.end(), items.begin(), items.end());
        remaining_ += static_cast<std::int64_t>(items.size());
    }
    std::int64_t remaining() const { return remaining_; }  ///< number of items in the queue

private:
    std::vector<Range> ranges_;           // [first item not yet taken, end)
    std::vector<std::int64_t> put_back_;  // items to hand out again
    std::size_t at_ = 0;                  // index of the first range with items left
    Shard shard_;
    std::int64_t remaining_ = 0;
};

}  // namespace corpuscle
