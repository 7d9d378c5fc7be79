#include "live/placed_frames.hpp"

#include <algorithm>

namespace corpuscle {
namespace {

class SiteFrames final : public FrameSource {
    std::unique_ptr<FrameSource> source_;
    std::vector<std::uint32_t> sites_;
    std::vector<double> frame_;

public:
    SiteFrames(std::unique_ptr<FrameSource> from, std::vector<std::uint32_t> sites)
        : source_(std::move(from)), sites_(std::move(sites)), frame_(sites_.size()) {}

    int waits_on() const override { return source_->waits_on(); }
    std::int64_t due() const override { return source_->due(); }
    Result<bool> receive() override { return source_->receive(); }
    void hurry() override { source_->hurry(); }
    FrameCounts counts() const override { return source_->counts(); }
    std::string sentence() const override { return source_->sentence(); }
    bool is_live() const override { return source_->is_live(); }
    std::size_t unread_bytes() const override { return source_->unread_bytes(); }
    std::optional<FrameMisfit> first_misfit() const override { return source_->first_misfit(); }
    FrameOrder* order() override { return source_->order(); }

    /// The last frame is taken from `force`, so that a resumed stream repeats the right values.
    Next next(std::span<double> force) override {
        for (std::size_t k = 0; k < sites_.size(); ++k) frame_[k] = force[sites_[k]];
        const auto next = source_->next(frame_);
        if (next == Next::nothing) return next;
        for (std::size_t k = 0; k < sites_.size(); ++k) force[sites_[k]] = frame_[k];
        return next;
    }
};

}  // namespace

std::unique_ptr<FrameSource> placed_frames(std::unique_ptr<FrameSource> from, std::vector<std::uint32_t> sites, std::size_t all_sites) {
    std::uint32_t next = 0;
    const bool in_order = std::all_of(sites.begin(), sites.end(), [&](std::uint32_t site) { return site == next++; });
    if (in_order && sites.size() == all_sites) return from;
    return std::make_unique<SiteFrames>(std::move(from), std::move(sites));
}

}  // namespace corpuscle
