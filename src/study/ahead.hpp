#pragma once
// A source read ahead of the block that is answered, for afferents whose answer is behind the force.

#include <span>
#include <vector>

#include "signal/source.hpp"

namespace corpuscle {

/// Blocks of a source, and of each channel so many samples more; after the end its last force goes on.
class Ahead {
    std::size_t more_;                       // samples
    std::vector<std::vector<double>> held_;  // of each channel, from the block's first sample on; empty if there is no more
    std::size_t block_ = 0, left_ = 0;       // samples of the last block; those of the source in held_
    bool ended_ = false;

    Result<void> fill(Source&, Frames&);

public:
    Ahead(std::size_t channels, std::size_t more) : more_(more), held_(channels) {}

    /// The next block; count 0 is the end.
    Result<void> next(Source&, Frames&);
    /// Samples of a channel, counted from the block's first; as far as `more` behind its last.
    std::span<const double> of(std::size_t channel, std::size_t from, std::size_t count) const {
        return std::span(held_[channel]).subspan(from, count);
    }
};

}  // namespace corpuscle
