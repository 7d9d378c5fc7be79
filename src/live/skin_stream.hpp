#pragma once
// A skin that answers frame by frame: one frame of forces in, the spikes that arrive in it out. No lock, no memory asked for once it is
// made, and the same spikes as a recording answered as a whole.

#include <span>
#include <vector>

#include "skin/skin.hpp"

namespace corpuscle {

class SkinStream {
    std::shared_ptr<const Innervation> innervation_;
    Clock clock_;
    std::unique_ptr<Skin> skin_;
    Pool here_{1};
    std::vector<std::uint32_t> touched_, every_;
    std::vector<Spike> spikes_;
    // Frames that are answered together: [site][frame], of the sites that any of them touches.
    std::size_t together_ = 1, gathered_ = 0;
    std::vector<double> block_;
    std::vector<std::uint32_t> in_block_;
    std::vector<std::uint8_t> is_in_block_;

    SkinStream(std::shared_ptr<const Innervation> innervation, const Clock& clock, std::unique_ptr<Skin> skin)
        : innervation_(std::move(innervation)), clock_(clock), skin_(std::move(skin)) {}
    void make_room(std::size_t together);
    Result<void> warm_up();
    std::span<const std::uint32_t> touched_by(std::span<const double> frame);

public:
    /// `sampled`: spikes on the samples, not between them. `together`: frames that may be gathered.
    static Result<std::unique_ptr<SkinStream>> make(std::shared_ptr<const Innervation>, const Clock&, bool sampled = false,
                                                    std::size_t together = 1);

    const Innervation& innervation() const { return *innervation_; }
    const Clock& clock() const { return clock_; }
    std::size_t sites() const { return skin_->sites(); }
    std::int64_t frames() const { return skin_->step(); }  ///< answered so far
    const SkinWork& work() const { return skin_->work(); }

    /// One force (N) a site. The spikes that arrive in this frame, in order of time, then unit; they stay until the next call.
    Result<std::span<const Spike>> push(std::span<const double> frame);
    std::size_t together() const { return together_; }
    /// One more frame, kept to be answered together with others: less work, and the same spikes later. True: it is time to answer them.
    bool gather(std::span<const double> frame);
    /// The spikes that arrive in the frames gathered; there may be none.
    Result<std::span<const Spike>> answer_gathered();

    /// At the end of it all: the spikes still on their way.
    std::span<const Spike> last();

    /// Where it stands; the same population at the same rate goes on from there.
    std::vector<std::byte> save() const { return skin_->save(); }
    Result<void> resume(std::span<const std::byte> state) { return skin_->resume(state); }
};

}  // namespace corpuscle
