#pragma once
// Frames with fewer forces than a skin has sites.

#include <cstdint>
#include <vector>

#include "live/input/frame_source.hpp"

namespace corpuscle {

/// A source of frames with a force for each of the `all_sites` sites of a skin. `from` delivers frames of sites.size() forces: force k is
/// assigned to site sites[k], and the force at other sites is not changed. If `sites` are all sites in order, `from` itself is returned.
std::unique_ptr<FrameSource> assign_sites(std::unique_ptr<FrameSource> from, std::vector<std::uint32_t> sites, std::size_t all_sites);

}  // namespace corpuscle
