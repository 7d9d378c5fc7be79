#include "study/sweep/unit_queue.hpp"

#include <algorithm>

namespace corpuscle {

std::vector<std::int64_t> UnitQueue::take(std::int64_t most) {
    std::vector<std::int64_t> out;
    out.reserve(static_cast<std::size_t>(std::clamp<std::int64_t>(most, 0, left_)));
    const auto wanted = [&] { return static_cast<std::int64_t>(out.size()) < most; };
    for (; wanted() && !back_.empty(); back_.pop_back()) out.push_back(back_.back());
    for (; wanted() && at_ < ranges_.size(); ++at_) {
        auto& [from, to] = ranges_[at_];
        for (; from < to && wanted(); ++from)
            if (shard_.has(from)) out.push_back(from);
        if (from < to) break;
    }
    left_ -= static_cast<std::int64_t>(out.size());
    return out;
}

}  // namespace corpuscle
