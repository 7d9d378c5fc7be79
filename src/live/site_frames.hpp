#pragma once
// Frames with fewer forces than a skin has sites.

#include <cstdint>
#include <vector>

#include "live/frame_source.hpp"

namespace corpuscle {

/// Assigns force k of each frame to site sites[k]; the other sites get no force. `from` delivers frames of sites.size() forces. It is
/// returned unchanged if `sites` are all sites in order. `all_sites`: the number of sites of the skin.
std::unique_ptr<FrameSource> assign_sites(std::unique_ptr<FrameSource> from, std::vector<std::uint32_t> sites, std::size_t all_sites);

}  // namespace corpuscle
