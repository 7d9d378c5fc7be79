#include "live/input/filtered_frames.hpp"

#include <vector>

#include "live/input/wrapped_frames.hpp"

namespace corpuscle {
namespace {

class FilteredFrames final : public WrappedFrames {
    std::vector<std::vector<Biquad>> filters_;  // of each site
    std::vector<double> frame_;                 // the last frame of source_, N

public:
    FilteredFrames(std::unique_ptr<FrameSource> from, std::size_t sites, std::span<const Biquad> filters)
        : WrappedFrames(std::move(from)), filters_(sites, {filters.begin(), filters.end()}), frame_(sites) {}

    Next next(std::span<double> force) override {
        const auto next = source_->next(frame_);
        if (next == Next::nothing) return next;
        for (std::size_t s = 0; s < frame_.size(); ++s) {
            force[s] = frame_[s];
            for (auto& filter : filters_[s]) force[s] = filter.next(force[s]);
        }
        return next;
    }
};

}  // namespace

std::unique_ptr<FrameSource> filter_frames(std::unique_ptr<FrameSource> from, std::size_t sites, std::span<const Biquad> filters) {
    if (filters.empty()) return from;
    return std::make_unique<FilteredFrames>(std::move(from), sites, filters);
}

}  // namespace corpuscle
