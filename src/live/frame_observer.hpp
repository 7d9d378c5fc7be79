#pragma once
// Sees the frames and spikes of a stream while it runs, in the thread of the stream loop.

#include <cstdint>
#include <span>

#include "core/spike.hpp"

namespace corpuscle {

/// Its functions are called after the spikes have been written. They must not wait, because the next frame would be late.
class FrameObserver {
public:
    virtual ~FrameObserver() = default;
    /// `frame`: its number, from 0; its time is that of this sample. `force`: of all sites, N.
    virtual void add_frame(std::int64_t frame, std::span<const double> force) = 0;
    virtual void add_spikes(std::span<const Spike>) = 0;
};

}  // namespace corpuscle
