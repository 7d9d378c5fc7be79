#include "live/input/frame_source.hpp"

#include <algorithm>

namespace corpuscle {

void FrameSource::assign_sites(std::vector<std::uint32_t> sites, std::size_t all_sites, std::span<const Biquad> filters) {
    std::uint32_t next = 0;
    const bool in_order = std::all_of(sites.begin(), sites.end(), [&](std::uint32_t site) { return site == next++; });
    if (in_order && sites.size() == all_sites && filters.empty()) return;
    sites_ = std::move(sites);
    frame_.resize(sites_.size());
    if (!filters.empty()) filters_.assign(sites_.size(), {filters.begin(), filters.end()});
}

FrameSource::Next FrameSource::next(std::span<double> force) {
    if (sites_.empty()) return read_frame(force);
    // Without filters, the last frame is taken from `force`. So a resumed stream, whose `force` is set by the caller, repeats the right
    // values.
    for (std::size_t k = 0; filters_.empty() && k < sites_.size(); ++k) frame_[k] = force[sites_[k]];
    const auto next = read_frame(frame_);
    if (next == Next::nothing) return next;
    for (std::size_t k = 0; k < sites_.size(); ++k) {
        double& filtered = force[sites_[k]] = frame_[k];
        if (filters_.empty()) continue;
        for (auto& filter : filters_[k]) filtered = filter.next(filtered);
    }
    return next;
}

}  // namespace corpuscle
