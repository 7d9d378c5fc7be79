#include "sweep/parallel/item_queue.hpp"

#include <algorithm>

namespace corpuscle {

std::vector<std::int64_t> ItemQueue::take(std::int64_t max) {
    std::vector<std::int64_t> out;
    out.reserve(static_cast<std::size_t>(std::clamp<std::int64_t>(max, 0, remaining_)));
    const auto has_room = [&] { return static_cast<std::int64_t>(out.size()) < max; };
    for (; has_room() && at_ < ranges_.size(); ++at_) {
        auto& [from, to] = ranges_[at_];
        for (; from < to && has_room(); ++from)
            if (shard_.contains(from) && part_.contains(passed_++)) out.push_back(from);
        if (from < to) break;
    }
    remaining_ -= static_cast<std::int64_t>(out.size());
    return out;
}

}  // namespace corpuscle
