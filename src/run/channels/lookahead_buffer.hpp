#pragma once
// Reads a source of force some samples ahead, for afferents whose response lags behind the force.

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

    Result<void> fill(ForceSource&, Frames& block);

public:
    LookaheadBuffer(std::size_t channels, std::size_t lookahead) : lookahead_(lookahead), buffer_(channels) {}

    /// Reads the next block; a count of 0 marks the end.
    Result<void> next(ForceSource&, Frames&);
    /// `count` samples of a channel from sample `from` of the last block on. The range may end up to `lookahead` samples after the block.
    /// Only if `lookahead` is not 0.
    std::span<const double> samples(std::size_t channel, std::size_t from, std::size_t count) const {
        return std::span(buffer_[channel]).subspan(from, count);
    }
};

}  // namespace corpuscle
