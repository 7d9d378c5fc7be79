// Frames out of bytes, in their order.

#include "live/frame_decoder.hpp"
#include "live/frame_source.hpp"

namespace corpuscle {
namespace {

class ByteFrames final : public FrameSource {
    std::unique_ptr<ByteSource> source_;
    FrameDecoder decoder_;
    FrameOrder order_;
    FrameCounts counts_;
    std::int64_t hold_ = 0, release_ = 0;  // to be put before the one that was found
    bool found_ = false;
    std::size_t misfits_ = 0;  // frames that could not be read, whose places are to be filled

    bool is_refused() const { return decoder_.refused_header() && source_->has_one_sender(); }
    bool numbered() const { return decoder_.layout().stamp != FrameStamp::none; }

    /// Looks at the next frame's number: whether it is to be answered, and what before it.
    void find() {
        if (!numbered()) {
            found_ = true;
            return;
        }
        const auto turn = order_.turn(decoder_.number());
        found_ = turn.take, hold_ = turn.hold, release_ = turn.release;
    }

    void sender_gone() {
        if (decoder_.begun()) ++counts_.halves, counts_.half_bytes = static_cast<std::int64_t>(decoder_.begun_bytes());
        decoder_.forget();
        order_.begin_anew();
    }

    void take_datagram(const Came& came) {
        if (came.from_another) sender_gone();
        if (decoder_.came_datagram(came.count)) return;
        ++counts_.unreadable;
        if (!numbered()) ++misfits_;
    }

public:
    ByteFrames(std::unique_ptr<ByteSource> source, const FrameLayout& layout, std::int64_t hold, std::int64_t longest, std::size_t together,
               HeaderReader read_header)
        : source_(std::move(source)), decoder_(layout, together, std::move(read_header)), order_(hold, longest) {
        if (layout.kind != FrameKind::csv) source_->enough(together * layout.bytes());
    }

    int waits_on() const override { return source_->waits_on(); }
    std::string sentence() const override { return source_->sentence(); }
    FrameOrder* order() override { return numbered() ? &order_ : nullptr; }

    FrameCounts counts() const override {
        auto counts = counts_;
        counts.headers = decoder_.headers(), counts.producers = source_->producers(), counts.order = order_.counts();
        counts.senders = source_->senders();
        return counts;
    }
    std::int64_t due() const override { return is_refused() ? 0 : source_->due(); }
    bool is_live() const override { return source_->is_live(); }
    std::size_t unread_bytes() const override { return source_->unread(); }
    std::optional<FrameMisfit> first_misfit() const override { return is_refused() ? std::nullopt : decoder_.first_misfit(); }

    void hurry() override { source_->enough(1); }

    Result<bool> receive() override {
        if (is_refused()) return *decoder_.refused_header();
        auto room = decoder_.room();
        if (source_->has_datagrams()) room = room.first(room.size() - 1);  // for the end of a line
        const auto came = source_->read(room);
        if (!came) return came.error();
        if (came->what == Came::bytes && source_->has_datagrams())
            take_datagram(*came);
        else if (came->what == Came::bytes)
            decoder_.came(came->count);
        if (came->what == Came::gone || came->what == Came::end) sender_gone();
        return came->what != Came::end;
    }

    Next next(std::span<double> force) override {
        for (;;) {
            if (misfits_ > 0) return --misfits_, Next::filled;
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
                    find();
                    break;
                case FrameDecoder::Found::unreadable:
                    if (is_refused()) return Next::nothing;  // receive() says why
                    ++counts_.unreadable;
                    if (!numbered()) return Next::filled;
            }
        }
    }
};

}  // namespace

std::unique_ptr<FrameSource> frames_of(std::unique_ptr<ByteSource> source, const FrameLayout& layout, std::int64_t hold,
                                       std::int64_t longest, std::size_t together, HeaderReader read_header) {
    return std::make_unique<ByteFrames>(std::move(source), layout, hold, longest, together, std::move(read_header));
}

}  // namespace corpuscle
