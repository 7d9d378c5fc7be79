#pragma once
// Simulates a skin frame by frame: one frame of forces in, the spikes that arrive during it out. It uses no locks and allocates no memory
// after construction. The spikes are the same as those of a recording of these frames.

#include <span>
#include <vector>

#include "skin/skin.hpp"

namespace corpuscle {

class SkinStream {
    std::shared_ptr<const Innervation> innervation_;
    Clock clock_;
    std::unique_ptr<Skin> skin_;
    ThreadPool pool_{1};
    std::vector<std::uint32_t> touched_, all_sites_;
    std::vector<Spike> spikes_;
    // Frames of a batch: [site][frame], for the sites that have force in any of them.
    std::size_t batch_frames_ = 1, batched_ = 0;
    std::vector<double> block_;
    std::vector<std::uint32_t> batch_sites_;
    std::vector<std::uint8_t> is_in_batch_;

    SkinStream(std::shared_ptr<const Innervation> innervation, const Clock& clock, std::unique_ptr<Skin> skin)
        : innervation_(std::move(innervation)), clock_(clock), skin_(std::move(skin)) {}
    void allocate(std::size_t batch_frames);
    Result<void> warm_up();
    std::span<const std::uint32_t> find_touched(std::span<const double> frame);

public:
    /// `spikes_on_samples`: spikes are put on samples, not between them. `batch_frames`: size of a batch.
    static Result<std::unique_ptr<SkinStream>> make(std::shared_ptr<const Innervation>, const Clock&, bool spikes_on_samples = false,
                                                    std::size_t batch_frames = 1);

    const Innervation& innervation() const { return *innervation_; }
    const Clock& clock() const { return clock_; }
    std::size_t sites() const { return skin_->sites(); }
    std::int64_t frames() const { return skin_->step(); }  ///< simulated so far
    const SkinStats& stats() const { return skin_->stats(); }

    /// Simulates one frame: one force (N) for each site. Returns the spikes that arrive during it, in order of time, then afferent; valid
    /// until the next call.
    Result<std::span<const Spike>> push(std::span<const double> frame);
    std::size_t batch_frames() const { return batch_frames_; }
    /// Adds a frame to the batch; returns true when the batch is full and run_batch() must be called. A batch takes less time than its
    /// frames one by one, but the spikes come later.
    bool add_to_batch(std::span<const double> frame);
    /// Simulates the frames of the batch, which may be empty. Returns the spikes that arrive during them; valid until the next call.
    Result<std::span<const Spike>> run_batch();

    /// Call after the last frame: the spikes that are still in transit.
    std::span<const Spike> finish();

    /// The state; a stream with the same population and rate can resume from it.
    std::vector<std::byte> save() const { return skin_->save(); }
    Result<void> resume(std::span<const std::byte> state) { return skin_->resume(state); }
};

}  // namespace corpuscle
