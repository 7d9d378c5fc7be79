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

}  // namespace corpuscle
