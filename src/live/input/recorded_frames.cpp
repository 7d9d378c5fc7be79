// A recording as a stream: each frame comes at its time, or frames come as fast as they can be simulated.

#include "live/input/frame_source.hpp"

namespace corpuscle {
namespace {

class RecordedFrames final : public FrameSource {
    static constexpr std::size_t block = 1024;      // frames read from the recording at once
    static constexpr std::int64_t max_batch = 256;  // largest number of frames between two calls of receive()

    std::unique_ptr<ForceSource> source_;
    Frames frames_;
    std::size_t at_ = 0;                     // index of the next frame in the block
    std::int64_t begun_ = -1;                // steady_now() of the first frame, ns; -1: not read yet
    std::int64_t count_ = 0, in_batch_ = 0;  // frames passed on: in total, and since the last call of receive()
    bool paced_;                             // true: each frame comes at its time

    /// The steady_now() at which a frame comes, counted from 0.
    std::int64_t due_of(std::int64_t frame) const {
        const auto& clock = source_->clock();
        // A cycle is `rate_denominator` seconds, which contain `rate_numerator` frames.
        const auto cycles = frame / clock.rate_numerator, rest = frame % clock.rate_numerator;
        return begun_ + cycles * clock.rate_denominator * 1'000'000'000 +
               static_cast<std::int64_t>(static_cast<double>(rest) * clock.T() * 1e9);
    }

public:
    RecordedFrames(std::unique_ptr<ForceSource> source, bool paced)
        : source_(std::move(source)), frames_(source_->channels().size(), block), paced_(paced) {}

    std::string description() const override { return source_->description(); }
    std::int64_t due_time() const override { return begun_ < 0 || !paced_ ? 0 : due_of(count_); }
    bool is_live() const override { return paced_; }
    FrameCounts counts() const override { return {.frames = count_, .sender_count = 1}; }

    Result<bool> receive() override {
        in_batch_ = 0;
        if (at_ == frames_.count) {
            TRY(source_->read(frames_));
            at_ = 0;
        }
        if (begun_ < 0) begun_ = steady_now();
        return frames_.count > 0;
    }

    Next read_frame(std::span<double> force) override {
        if (at_ == frames_.count || in_batch_ == max_batch || (paced_ && steady_now() < due_of(count_))) return Next::nothing;
        for (std::size_t s = 0; s < force.size(); ++s) force[s] = frames_.force[s][at_];
        ++at_, ++count_, ++in_batch_;
        return Next::frame;
    }
};

}  // namespace

std::unique_ptr<FrameSource> make_frame_source(std::unique_ptr<ForceSource> source, bool real_time) {
    return std::make_unique<RecordedFrames>(std::move(source), real_time);
}

}  // namespace corpuscle
