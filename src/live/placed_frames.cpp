#include "live/placed_frames.hpp"

#include <algorithm>

namespace corpuscle {
namespace {

class PlacedFrames final : public FrameSource {
    std::unique_ptr<FrameSource> from_;
    std::vector<std::uint32_t> sites_;
    std::vector<double> own_;

public:
    PlacedFrames(std::unique_ptr<FrameSource> from, std::vector<std::uint32_t> sites)
        : from_(std::move(from)), sites_(std::move(sites)), own_(sites_.size()) {}

    int waits_on() const override { return from_->waits_on(); }
    std::int64_t due() const override { return from_->due(); }
    Result<bool> receive() override { return from_->receive(); }
    void hurry() override { from_->hurry(); }
    FrameCounts counts() const override { return from_->counts(); }
    std::string sentence() const override { return from_->sentence(); }
    bool is_live() const override { return from_->is_live(); }
    std::size_t unread_bytes() const override { return from_->unread_bytes(); }
    std::optional<FrameMisfit> first_misfit() const override { return from_->first_misfit(); }
    FrameOrder* order() override { return from_->order(); }

    /// The last frame is what `force` holds, so that a stream that is resumed holds what it held.
    Next next(std::span<double> force) override {
        for (std::size_t k = 0; k < sites_.size(); ++k) own_[k] = force[sites_[k]];
        const auto next = from_->next(own_);
        if (next == Next::nothing) return next;
        for (std::size_t k = 0; k < sites_.size(); ++k) force[sites_[k]] = own_[k];
        return next;
    }
};

}  // namespace

std::unique_ptr<FrameSource> placed_frames(std::unique_ptr<FrameSource> from, std::vector<std::uint32_t> sites, std::size_t all_sites) {
    std::uint32_t next = 0;
    const bool in_order = std::all_of(sites.begin(), sites.end(), [&](std::uint32_t site) { return site == next++; });
    if (in_order && sites.size() == all_sites) return from;
    return std::make_unique<PlacedFrames>(std::move(from), std::move(sites));
}

}  // namespace corpuscle
