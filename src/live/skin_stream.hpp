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

    SkinStream(std::shared_ptr<const Innervation> innervation, const Clock& clock, std::unique_ptr<Skin> skin)
        : innervation_(std::move(innervation)), clock_(clock), skin_(std::move(skin)) {}
    Result<void> warm_up();
    std::span<const std::uint32_t> touched_by(std::span<const double> frame);

public:
    /// `sampled`: spikes on the samples, not between them.
    static Result<std::unique_ptr<SkinStream>> make(std::shared_ptr<const Innervation>, const Clock&, bool sampled = false);

    const Innervation& innervation() const { return *innervation_; }
    const Clock& clock() const { return clock_; }
    std::size_t sites() const { return skin_->sites(); }
    std::int64_t frames() const { return skin_->step(); }  ///< answered so far
    const SkinWork& work() const { return skin_->work(); }

    /// One force (N) a site. The spikes that arrive in this frame, in order of time, then unit; they stay until the next call.
    Result<std::span<const Spike>> push(std::span<const double> frame);
    /// At the end of it all: the spikes still on their way.
    std::span<const Spike> last();

    /// Where it stands; the same population at the same rate goes on from there.
    std::vector<std::byte> save() const { return skin_->save(); }
    Result<void> resume(std::span<const std::byte> state) { return skin_->resume(state); }
};

}  // namespace corpuscle
