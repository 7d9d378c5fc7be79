#pragma once
// The units that are still to be done, handed out in blocks.

#include <cstdint>
#include <utility>
#include <vector>

namespace corpuscle {

/// Which part of a sweep is done here: units k with k % of == index.
struct Shard {
    std::int64_t index = 0, of = 1;

    bool has(std::int64_t unit) const { return unit % of == index; }
    /// How many of [from, to).
    std::int64_t count(std::int64_t from, std::int64_t to) const { return before(to) - before(from); }

private:
    std::int64_t before(std::int64_t unit) const { return (unit + of - 1 - index) / of; }
};

class UnitQueue {
public:
    using Range = std::pair<std::int64_t, std::int64_t>;  ///< [first, second)

    UnitQueue(std::vector<Range> missing, Shard shard) : ranges_(std::move(missing)), shard_(shard) {
        for (const auto& [from, to] : ranges_) left_ += shard_.count(from, to);
    }

    /// The next ones, in order, `most` of them if there are so many; those that came back first.
    std::vector<std::int64_t> take(std::int64_t most);
    /// To be handed out again.
    void put_back(const std::vector<std::int64_t>& units) {
        back_.insert(back_.end(), units.begin(), units.end());
        left_ += static_cast<std::int64_t>(units.size());
    }
    std::int64_t left() const { return left_; }

private:
    std::vector<Range> ranges_;
    std::vector<std::int64_t> back_;
    std::size_t at_ = 0;
    Shard shard_;
    std::int64_t left_ = 0;
};

}  // namespace corpuscle
