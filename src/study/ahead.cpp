#include "study/ahead.hpp"

#include <algorithm>

namespace corpuscle {

Result<void> Ahead::next(ForceSource& source, Frames& block) {
    if (more_ == 0) return source.read(block);
    for (auto& channel : held_) channel.erase(channel.begin(), channel.begin() + static_cast<std::ptrdiff_t>(block_));
    left_ -= block_;
    if (auto ok = fill(source, block); !ok) return ok;
    block_ = block.count = std::min(block.capacity, ended_ ? left_ : left_ - more_);
    for (std::size_t c = 0; c < held_.size(); ++c) std::copy_n(held_[c].begin(), block_, block.force[c].begin());
    return {};
}

/// Reads until there is a full block and all samples to look ahead behind it.
Result<void> Ahead::fill(ForceSource& source, Frames& block) {
    while (!ended_ && left_ < block.capacity + more_) {
        if (auto ok = source.read(block); !ok) return ok;
        ended_ = block.count == 0;
        left_ += block.count;
        for (std::size_t c = 0; c < held_.size(); ++c) {
            auto& channel = held_[c];
            const auto& force = block.force[c];
            channel.insert(channel.end(), force.begin(), force.begin() + static_cast<std::ptrdiff_t>(block.count));
            if (ended_ && !channel.empty()) channel.insert(channel.end(), more_, channel.back());
        }
    }
    return {};
}

}  // namespace corpuscle
