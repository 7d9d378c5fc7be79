#include "live/input/site_frames.hpp"

#include <algorithm>

#include "live/input/wrapped_frames.hpp"

namespace corpuscle {
namespace {

class SiteFrames final : public WrappedFrames {
    std::vector<std::uint32_t> sites_;
    std::vector<double> frame_;  // the frame of source_

public:
    SiteFrames(std::unique_ptr<FrameSource> from, std::vector<std::uint32_t> sites)
        : WrappedFrames(std::move(from)), sites_(std::move(sites)), frame_(sites_.size()) {}

    /// The last frame of `source_` is taken from `force`. So a resumed stream, whose `force` is set by the caller, repeats the right
    /// values.
    Next next(std::span<double> force) override {
        for (std::size_t k = 0; k < sites_.size(); ++k) frame_[k] = force[sites_[k]];
        const auto next = source_->next(frame_);
        if (next == Next::nothing) return next;
        for (std::size_t k = 0; k < sites_.size(); ++k) force[sites_[k]] = frame_[k];
        return next;
    }
};

}  // namespace

std::unique_ptr<FrameSource> assign_sites(std::unique_ptr<FrameSource> from, std::vector<std::uint32_t> sites, std::size_t all_sites) {
    std::uint32_t next = 0;
    const bool in_order = std::all_of(sites.begin(), sites.end(), [&](std::uint32_t site) { return site == next++; });
    if (in_order && sites.size() == all_sites) return from;
    return std::make_unique<SiteFrames>(std::move(from), std::move(sites));
}

}  // namespace corpuscle
