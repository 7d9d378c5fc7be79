#pragma once
// Base of the sources that change the frames of another source.

#include <utility>

#include "live/input/frame_source.hpp"

namespace corpuscle {

/// Passes everything but next() on to the other source.
class WrappedFrames : public FrameSource {
protected:
    std::unique_ptr<FrameSource> source_;

public:
    explicit WrappedFrames(std::unique_ptr<FrameSource> from) : source_(std::move(from)) {}

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
};

}  // namespace corpuscle
