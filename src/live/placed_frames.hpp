#pragma once
// Frames of fewer forces than a skin has sites.

#include <cstdint>
#include <vector>

#include "live/frame_source.hpp"

namespace corpuscle {

/// Force k of each frame goes to site sites[k]; the others of all_sites have none. `from` gives frames of sites.size() forces, and is
/// returned as it is where these are all sites in order.
std::unique_ptr<FrameSource> placed_frames(std::unique_ptr<FrameSource> from, std::vector<std::uint32_t> sites, std::size_t all_sites);

}  // namespace corpuscle
