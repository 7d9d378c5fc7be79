#include "live/input/frame_source.hpp"

#include <algorithm>

#include "live/input/frame_decoder.hpp"

namespace corpuscle {
namespace {

/// A source of frames that decodes them from bytes and fills gaps in their sequence.
class ByteFrames final : public FrameSource {
    std::unique_ptr<ByteSource> source_;
    FrameDecoder decoder_;
    FrameSequence order_;
    FrameCounts counts_;
    std::int64_t hold_ = 0, release_ = 0;  // numbers of frames to insert before the found one: with the last force, then without force
    bool found_ = false;                   // true: the decoder has found a frame that has not been passed on yet
    std::size_t unnumbered_errors_ = 0;    // unreadable datagrams, if frames are not numbered; one frame is inserted for each

    /// True if the only sender's header was refused, so that the stream must end.
    bool has_header_error() const { return decoder_.header_error() && source_->has_one_sender(); }
    bool is_numbered() const { return decoder_.layout().stamp != FrameStamp::none; }

    /// Decides if the frame that the decoder has found is used, and how many frames are inserted before it.
    void classify_frame() {
        if (!is_numbered()) {
            found_ = true;
            return;
        }
        const auto decision = order_.decide(decoder_.number());
        found_ = decision.take, hold_ = decision.hold, release_ = decision.release;
    }

    /// Prepares for the next sender; bytes of an incomplete frame are counted and discarded.
    void end_sender() {
        if (decoder_.has_partial_frame())
            ++counts_.partial_frames, counts_.partial_bytes = static_cast<std::int64_t>(decoder_.partial_bytes());
        decoder_.reset();
        order_.restart();
    }

    /// Takes a datagram from the decoder's buffer. The buffer contains nothing else, because earlier datagrams consisted of whole frames,
    /// which have been decoded.
    void take_datagram(const ReadResult& received) {
        if (received.is_new_sender) end_sender();
        if (decoder_.add_datagram(received.count)) return;
        ++counts_.unreadable;
        if (!is_numbered()) ++unnumbered_errors_;
    }

public:
    ByteFrames(std::unique_ptr<ByteSource> source, const FrameLayout& layout, std::int64_t hold, std::int64_t max_gap,
               std::size_t batch_frames, HeaderReader read_header)
        : source_(std::move(source)), decoder_(layout, batch_frames, std::move(read_header)), order_(hold, max_gap) {
        if (layout.kind != FrameKind::csv) source_->set_low_watermark(batch_frames * layout.bytes());
    }

    int poll_fd() const override { return source_->poll_fd(); }
    std::string description() const override { return source_->description(); }
    FrameSequence* sequence() override { return is_numbered() ? &order_ : nullptr; }

    FrameCounts counts() const override {
        auto counts = counts_;
        counts.headers = decoder_.headers(), counts.sender_count = source_->sender_count(), counts.sequence = order_.counts();
        counts.senders = source_->sender_counts();
        return counts;
    }
    std::int64_t due_time() const override { return has_header_error() ? 0 : source_->due_time(); }
    bool is_live() const override { return source_->is_live(); }
    std::size_t unread_bytes() const override { return source_->unread_bytes(); }
    std::optional<FrameError> first_error() const override { return has_header_error() ? std::nullopt : decoder_.first_error(); }

    void disable_batching() override { source_->set_low_watermark(1); }

    Result<bool> receive() override {
        if (has_header_error()) return *decoder_.header_error();
        auto space = decoder_.buffer();
        if (source_->has_datagrams()) space = space.first(space.size() - 1);  // keeps space for a line end
        const auto received = TRY(source_->read(space));
        if (received.status == ReadResult::bytes && source_->has_datagrams())
            take_datagram(received);
        else if (received.status == ReadResult::bytes)
            decoder_.add_bytes(received.count);
        if (received.status == ReadResult::disconnected || received.status == ReadResult::end) end_sender();
        return received.status != ReadResult::end;
    }

    Next read_frame(std::span<double> force) override {
        for (;;) {
            if (unnumbered_errors_ > 0) return --unnumbered_errors_, Next::filled;
            if (hold_ > 0) return --hold_, Next::filled;
            if (release_ > 0) {
                std::fill(force.begin(), force.end(), 0.0);
                is_released_ = true;
                return --release_, Next::filled;
            }
            if (std::exchange(found_, false)) {
                counts_.invalid_values += static_cast<std::int64_t>(decoder_.read_forces(force)), ++counts_.frames;
                return Next::frame;
            }
            switch (decoder_.next()) {
                case FrameDecoder::Status::nothing:
                    return Next::nothing;
                case FrameDecoder::Status::frame:
                    classify_frame();
                    break;
                case FrameDecoder::Status::unreadable:
                    if (has_header_error()) return Next::nothing;  // receive() returns the error
                    ++counts_.unreadable;
                    if (!is_numbered()) return Next::filled;
            }
        }
    }
};

/// A recording as a stream: each frame comes at its time, or frames come as fast as they can be simulated.
class RecordedFrames final : public FrameSource {
    static constexpr std::size_t block = 1024;      // frames read from the recording at once
    static constexpr std::int64_t max_batch = 256;  // largest number of frames between two calls of receive()

    std::unique_ptr<ForceSource> source_;
    Frames frames_;
    std::size_t at_ = 0;                     // index of the next frame in the block
    std::int64_t begun_ = -1;                // steady_now() of the first frame, ns; -1: not read yet
    std::int64_t count_ = 0, in_batch_ = 0;  // frames passed on: in total, and since the last call of receive()
    bool paced_;                             // true: each frame comes at its time
    bool with_shear_;                        // true: a frame has three forces for each channel

    /// The steady_now() at which a frame comes, counted from 0.
    std::int64_t due_of(std::int64_t frame) const {
        const auto& clock = source_->clock();
        // A cycle is `rate_denominator` seconds, which contain `rate_numerator` frames.
        const auto cycles = frame / clock.rate_numerator, rest = frame % clock.rate_numerator;
        return begun_ + cycles * clock.rate_denominator * 1'000'000'000 +
               static_cast<std::int64_t>(static_cast<double>(rest) * clock.T() * 1e9);
    }

public:
    RecordedFrames(std::unique_ptr<ForceSource> source, bool paced, bool with_shear)
        : source_(std::move(source)), frames_(source_->channels().size(), block, with_shear), paced_(paced), with_shear_(with_shear) {}

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
        for (std::size_t c = 0; c < frames_.force.size(); ++c)
            if (with_shear_)
                force[3 * c] = frames_.shear_x[c][at_], force[3 * c + 1] = frames_.shear_y[c][at_],
                          force[3 * c + 2] = frames_.force[c][at_];
            else
                force[c] = frames_.force[c][at_];
        ++at_, ++count_, ++in_batch_;
        return Next::frame;
    }
};

}  // namespace

void FrameSource::assign_sites(std::vector<std::uint32_t> sites, std::size_t all_sites, const ChannelFilters& filters) {
    std::uint32_t next = 0;
    const bool in_order = std::all_of(sites.begin(), sites.end(), [&](std::uint32_t site) { return site == next++; });
    if (in_order && sites.size() == all_sites && filters.empty()) return;
    sites_ = std::move(sites);
    frame_.resize(sites_.size());
    if (!filters.empty()) filters_.assign(sites_.size(), filters);
}

void FrameSource::assign_taxels(TaxelFrames taxels, std::vector<std::uint32_t> columns, std::size_t all_sites,
                                const ChannelFilters& filters) {
    sites_ = std::move(columns), taxels_ = std::move(taxels);
    frame_.resize(sites_.size()), taxel_force_.resize(taxels_.frame_size());
    if (taxels_.has_shear()) shear_x_.resize(all_sites), shear_y_.resize(all_sites);
    if (!filters.empty()) filters_.assign(sites_.size(), filters);
}

/// Force k of the last frame, filtered. A frame that was inserted to have no force has the rest level of --zero, which becomes 0.
double FrameSource::filtered(std::size_t k) {
    if (filters_.empty()) return frame_[k];
    const auto& rest = filters_[k].rest;
    return filters_[k].next(is_released_ && rest.is_used() && rest.is_known() ? rest.level() : frame_[k]);
}

FrameSource::Next FrameSource::next(std::span<double> force) {
    is_released_ = false;
    if (sites_.empty()) return read_frame(force);
    const bool has_taxels = taxels_.frame_size() > 0;
    // Without filters, the last frame is taken from `force`. So a resumed stream, whose `force` is set by the caller, repeats the right
    // values.
    for (std::size_t k = 0; filters_.empty() && !has_taxels && k < sites_.size(); ++k) frame_[k] = force[sites_[k]];
    const auto next = read_frame(frame_);
    if (next == Next::nothing) return next;
    const auto out = has_taxels ? std::span(taxel_force_) : force;
    for (std::size_t k = 0; k < sites_.size(); ++k) out[sites_[k]] = filtered(k);
    if (has_taxels) taxels_.spread(taxel_force_.data(), force.data(), shear_x_.data(), shear_y_.data());
    return next;
}

std::unique_ptr<FrameSource> make_frame_source(std::unique_ptr<ByteSource> source, const FrameLayout& layout, std::int64_t hold,
                                               std::int64_t max_gap, std::size_t batch_frames, HeaderReader read_header) {
    return std::make_unique<ByteFrames>(std::move(source), layout, hold, max_gap, batch_frames, std::move(read_header));
}

std::unique_ptr<FrameSource> make_frame_source(std::unique_ptr<ForceSource> source, bool real_time, bool with_shear) {
    return std::make_unique<RecordedFrames>(std::move(source), real_time, with_shear);
}

}  // namespace corpuscle
