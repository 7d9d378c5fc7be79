#include "live/input/site_frames.hpp"

#include <algorithm>

namespace corpuscle {
namespace {

class SiteFrames final : public FrameSource {
    std::unique_ptr<FrameSource> source_;
    std::vector<std::uint32_t> sites_;
    std::vector<double> frame_;  // the frame of source_

public:
    SiteFrames(std::unique_ptr<FrameSource> from, std::vector<std::uint32_t> sites)
        : source_(std::move(from)), sites_(std::move(sites)), frame_(sites_.size()) {}

    int poll_fd() const override { return source_->poll_fd(); }
    std::int64_t due_time() const override { return source_->due_time(); }
    Result<bool> receive() override { return source_->receive(); }
    void disable_batching() override { source_->disable_batching(); }
    FrameCounts counts() const override { return source_->counts(); }
    std::string description() const override { return source_->description(); }
    bool is_live() const override { return source_->is_live(); }
    std::size_t unread_bytes() const override { return source_->unread_bytes(); }
    std::optional<FrameError> first_error() const override { return source_->first_error(); }
    FrameSequence* sequence() override { return source_->sequence(); }

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
