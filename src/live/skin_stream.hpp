#pragma once
// Simulates a skin frame by frame: one frame of forces in, the spikes out that arrive at the recording point during this frame. It uses no
// locks and allocates no memory after construction. The spikes are the same as those of a recording that contains these frames.

#include "skin/skin.hpp"

namespace corpuscle {

class SkinStream {
    std::shared_ptr<const Innervation> innervation_;
    Clock clock_;
    std::unique_ptr<Skin> skin_;
    ThreadPool pool_{1};
    std::vector<std::uint32_t> touched_, all_sites_;  // touched_: scratch array of find_touched(); all_sites_: 0, 1, 2 ...
    std::vector<Spike> spikes_;                       // the last result
    std::size_t batch_frames_ = 1, batched_ = 0;      // frames of a full batch, and of the current one so far
    std::vector<double> shear_blocks_[2];             // the same for the shear along x and y; empty before the first frame with shear
    std::vector<double> block_;                       // forces of the batch, [site][frame]; only those of batch_sites_ are valid
    std::vector<std::uint32_t> batch_sites_;          // sites with force in a frame of the batch
    std::vector<std::uint8_t> is_in_batch_;           // for each site: 1 if it is in batch_sites_

    SkinStream(std::shared_ptr<const Innervation>, const Clock&, std::unique_ptr<Skin>, std::size_t batch_frames);
    Result<void> warm_up();
    std::span<const std::uint32_t> find_touched(std::span<const double> frame);
    std::span<const std::uint32_t> find_sheared(std::span<const double> frame, std::span<const double> shear_x,
                                                std::span<const double> shear_y);

public:
    /// `clock` gives the rate of the frames. If `spikes_on_samples` is true, a spike occurs at a sample, not between two. `batch_frames`:
    /// number of frames in a batch.
    static Result<std::unique_ptr<SkinStream>> make(std::shared_ptr<const Innervation>, const Clock& clock, bool spikes_on_samples = false,
                                                    std::size_t batch_frames = 1);

    const Innervation& innervation() const { return *innervation_; }
    const Clock& clock() const { return clock_; }
    std::size_t sites() const { return skin_->sites(); }
    std::int64_t frames() const { return skin_->step(); }  ///< number of frames simulated so far
    const SkinStats& stats() const { return skin_->stats(); }

    /// Simulates one frame: one force (N) for each site, and optionally the shear along x and y, which every
    /// frame must then have. Returns the spikes that arrive during it, in order of time, then afferent. They
    /// are valid until the next call.
    Result<std::span<const Spike>> push(std::span<const double> frame, std::span<const double> shear_x = {},
                                        std::span<const double> shear_y = {});
    std::size_t batch_frames() const { return batch_frames_; }
    /// Adds a frame to the batch; returns true if the batch is now full and run_batch() must be called. Simulating a batch takes less time
    /// than simulating its frames one by one, but the spikes come later.
    bool add_to_batch(std::span<const double> frame, std::span<const double> shear_x = {}, std::span<const double> shear_y = {});
    /// Simulates the frames of the batch, which may be empty. Returns the spikes that arrive during them; valid until the next call.
    Result<std::span<const Spike>> run_batch();

    /// The spikes that are still in transit. Call it after the last frame.
    std::span<const Spike> finish();

    /// The state; a stream with the same population and rate can resume from it.
    std::vector<std::byte> save() const { return skin_->save(); }
    Result<void> resume(std::span<const std::byte> state) { return skin_->resume(state); }
};

}  // namespace corpuscle
