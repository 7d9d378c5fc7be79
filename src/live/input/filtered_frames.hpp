#pragma once
// Frames whose forces are filtered, as those of a recording are.

#include <memory>
#include <span>

#include "io/quality/biquad.hpp"
#include "live/input/frame_source.hpp"

namespace corpuscle {

/// A source that filters each of the `sites` forces of the frames of `from` by all `filters`, in order. Frames that are inserted for
/// missing ones are filtered, too.
std::unique_ptr<FrameSource> filter_frames(std::unique_ptr<FrameSource> from, std::size_t sites, std::span<const Biquad> filters);

}  // namespace corpuscle
