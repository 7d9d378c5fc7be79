#pragma once
// Look-ahead on a source, for afferents whose response lags behind the force.

#include <span>
#include <vector>

#include "signal/force_source.hpp"

namespace corpuscle {

/// Reads blocks of a source and, for each channel, `lookahead` further samples. After the end of the source its last force is repeated.
class LookaheadBuffer {
    std::size_t lookahead_;                    // samples to look ahead
    std::vector<std::vector<double>> buffer_;  // force of each channel from the block's first sample on; empty without look-ahead
    std::size_t block_ = 0, available_ = 0;    // samples of the last block; samples of the source in the buffer
    bool ended_ = false;

    Result<void> fill(ForceSource&, Frames&);

public:
    LookaheadBuffer(std::size_t channels, std::size_t lookahead) : lookahead_(lookahead), buffer_(channels) {}

    /// Reads the next block; count 0 means the end.
    Result<void> next(ForceSource&, Frames&);
    /// Samples of a channel, counted from the block's first; the range may end up to `lookahead` samples after the block.
    std::span<const double> samples(std::size_t channel, std::size_t from, std::size_t count) const {
        return std::span(buffer_[channel]).subspan(from, count);
    }
};

}  // namespace corpuscle
