#include "run/channels/lookahead_buffer.hpp"

#include <algorithm>

namespace corpuscle {

Result<void> LookaheadBuffer::next(ForceSource& source, Frames& block) {
    if (lookahead_ == 0) return source.read(block);
    for (auto& channel : buffer_) channel.erase(channel.begin(), channel.begin() + static_cast<std::ptrdiff_t>(last_block_));
    available_ -= last_block_;
    TRY(fill(source, block));
    // Before the end of the source, fill() leaves at least lookahead_ samples after the block.
    last_block_ = block.count = std::min(block.capacity, ended_ ? available_ : available_ - lookahead_);
    for (std::size_t c = 0; c < buffer_.size(); ++c) std::copy_n(buffer_[c].begin(), last_block_, block.force[c].begin());
    return {};
}

/// Reads until the buffer has a full block and the look-ahead after it, or the source ends. Uses `block` to read into.
Result<void> LookaheadBuffer::fill(ForceSource& source, Frames& block) {
    while (!ended_ && available_ < block.capacity + lookahead_) {
        TRY(source.read(block));
        ended_ = block.count == 0;
        available_ += block.count;
        for (std::size_t c = 0; c < buffer_.size(); ++c) {
            auto& channel = buffer_[c];
            const auto& force = block.force[c];
            channel.insert(channel.end(), force.begin(), force.begin() + static_cast<std::ptrdiff_t>(block.count));
            if (ended_ && !channel.empty()) channel.insert(channel.end(), lookahead_, channel.back());
        }
    }
    return {};
}

}  // namespace corpuscle
