// Decodes frames from bytes and puts them in order.

#include "live/frame_decoder.hpp"
#include "live/frame_source.hpp"

namespace corpuscle {
namespace {

class ByteFrames final : public FrameSource {
    std::unique_ptr<ByteSource> source_;
    FrameDecoder decoder_;
    FrameOrder order_;
    FrameCounts counts_;
    std::int64_t hold_ = 0, release_ = 0;  // frames to insert before the found one
    bool found_ = false;
    std::size_t unnumbered_errors_ = 0;  // unreadable frames without a number; each is replaced by a filled one

    bool has_header_error() const { return decoder_.refused_header() && source_->has_one_sender(); }
    bool is_numbered() const { return decoder_.layout().stamp != FrameStamp::none; }

    /// Reads the number of the next frame and decides if it is used, and how many frames are inserted before it.
    void classify_frame() {
        if (!is_numbered()) {
            found_ = true;
            return;
        }
        const auto decision = order_.turn(decoder_.number());
        found_ = decision.take, hold_ = decision.hold, release_ = decision.release;
    }

    void end_sender() {
        if (decoder_.begun()) ++counts_.halves, counts_.half_bytes = static_cast<std::int64_t>(decoder_.begun_bytes());
        decoder_.forget();
        order_.begin_anew();
    }

    void take_datagram(const Came& received) {
        if (received.from_another) end_sender();
        if (decoder_.came_datagram(received.count)) return;
        ++counts_.unreadable;
        if (!is_numbered()) ++unnumbered_errors_;
    }

public:
    ByteFrames(std::unique_ptr<ByteSource> source, const FrameLayout& layout, std::int64_t hold, std::int64_t max_gap,
               std::size_t batch_frames, HeaderReader read_header)
        : source_(std::move(source)), decoder_(layout, batch_frames, std::move(read_header)), order_(hold, max_gap) {
        if (layout.kind != FrameKind::csv) source_->enough(batch_frames * layout.bytes());
    }

    int waits_on() const override { return source_->waits_on(); }
    std::string sentence() const override { return source_->sentence(); }
    FrameOrder* order() override { return is_numbered() ? &order_ : nullptr; }

    FrameCounts counts() const override {
        auto counts = counts_;
        counts.headers = decoder_.headers(), counts.producers = source_->producers(), counts.order = order_.counts();
        counts.senders = source_->senders();
        return counts;
    }
    std::int64_t due() const override { return has_header_error() ? 0 : source_->due(); }
    bool is_live() const override { return source_->is_live(); }
    std::size_t unread_bytes() const override { return source_->unread(); }
    std::optional<FrameMisfit> first_misfit() const override { return has_header_error() ? std::nullopt : decoder_.first_misfit(); }

    void hurry() override { source_->enough(1); }

    Result<bool> receive() override {
        if (has_header_error()) return *decoder_.refused_header();
        auto space = decoder_.room();
        if (source_->has_datagrams()) space = space.first(space.size() - 1);  // space for a line end
        const auto received = source_->read(space);
        if (!received) return received.error();
        if (received->what == Came::bytes && source_->has_datagrams())
            take_datagram(*received);
        else if (received->what == Came::bytes)
            decoder_.came(received->count);
        if (received->what == Came::gone || received->what == Came::end) end_sender();
        return received->what != Came::end;
    }

    Next next(std::span<double> force) override {
        for (;;) {
            if (unnumbered_errors_ > 0) return --unnumbered_errors_, Next::filled;
            if (hold_ > 0) return --hold_, Next::filled;
            if (release_ > 0) {
                std::fill(force.begin(), force.end(), 0.0);
                return --release_, Next::filled;
            }
            if (std::exchange(found_, false)) {
                counts_.values += static_cast<std::int64_t>(decoder_.take(force)), ++counts_.frames;
                return Next::frame;
            }
            switch (decoder_.next()) {
                case FrameDecoder::Found::nothing:
                    return Next::nothing;
                case FrameDecoder::Found::frame:
                    classify_frame();
                    break;
                case FrameDecoder::Found::unreadable:
                    if (has_header_error()) return Next::nothing;  // receive() returns the error
                    ++counts_.unreadable;
                    if (!is_numbered()) return Next::filled;
            }
        }
    }
};

}  // namespace

std::unique_ptr<FrameSource> frames_of(std::unique_ptr<ByteSource> source, const FrameLayout& layout, std::int64_t hold,
                                       std::int64_t max_gap, std::size_t batch_frames, HeaderReader read_header) {
    return std::make_unique<ByteFrames>(std::move(source), layout, hold, max_gap, batch_frames, std::move(read_header));
}

}  // namespace corpuscle
