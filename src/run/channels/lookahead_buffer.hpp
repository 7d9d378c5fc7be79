#pragma once
// Reads a source of force some samples ahead, for afferents whose response lags behind the force.

#include <algorithm>
#include <span>
#include <vector>

#include "core/force_source.hpp"

namespace corpuscle {

/// Reads blocks of a source and, for each channel, the `lookahead` samples after the block. After the end of the source, its last force is
/// repeated.
class LookaheadBuffer {
    std::size_t lookahead_;                    // samples to look ahead
    std::vector<std::vector<double>> buffer_;  // force of each channel from the block's first sample on; empty without look-ahead
    std::size_t last_block_ = 0;               // number of samples of the last block
    std::size_t available_ = 0;                // number of samples of the source in the buffer, without repetitions of the last force
    bool ended_ = false;                       // true after the end of the source has been read

    /// Reads until the buffer has a full block and the look-ahead after it, or the source ends. Uses `block` to read into.
    Result<void> fill(ForceSource& source, Frames& block) {
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

public:
    LookaheadBuffer(std::size_t channels, std::size_t lookahead) : lookahead_(lookahead), buffer_(channels) {}

    /// Reads the next block; a count of 0 marks the end.
    Result<void> next(ForceSource& source, Frames& block) {
        if (lookahead_ == 0) return source.read(block);
        for (auto& channel : buffer_) channel.erase(channel.begin(), channel.begin() + static_cast<std::ptrdiff_t>(last_block_));
        available_ -= last_block_;
        TRY(fill(source, block));
        // Before the end of the source, fill() leaves at least lookahead_ samples after the block.
        last_block_ = block.count = std::min(block.capacity, ended_ ? available_ : available_ - lookahead_);
        for (std::size_t c = 0; c < buffer_.size(); ++c) std::copy_n(buffer_[c].begin(), last_block_, block.force[c].begin());
        return {};
    }
    /// The first `count` samples of the last block and the look-ahead after it. Only if `lookahead` is not 0.
    std::span<const double> samples(std::size_t channel, std::size_t count) const { return std::span(buffer_[channel]).first(count); }
};

}  // namespace corpuscle
