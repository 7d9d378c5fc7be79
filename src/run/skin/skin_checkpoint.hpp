#pragma once
// Checkpoints of a skin run, so that it can be killed and resumed. FILE, named by --checkpoint, holds the skin's state after some
// sample; FILE.spikes holds all spikes up to this sample. When the same command is run again, it replays these spikes and continues, so
// every output is the same as without the interruption.

#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/checksum.hpp"
#include "core/text/input_files.hpp"
#include "run/skin/skin_force.hpp"

namespace corpuscle {

/// All options and files that determine the response of a run, as pairs of name and value: {"--scale", "0.02"}. For a file, the name begins
/// with "contents of", and the value is its checksum.
using RunFingerprint = std::vector<std::pair<std::string, std::string>>;

class SkinCheckpoint {
public:
    /// For a skin that has not started. If `file` exists, resumes the skin from it. Returns an error, and leaves the files unchanged, if
    /// the checkpoint is of another skin or run (the error names the difference), is damaged, is in use by another process, or is not a
    /// checkpoint.
    static Result<std::unique_ptr<SkinCheckpoint>> open(const std::string& file, Skin&, RunFingerprint);
    ~SkinCheckpoint();
    SkinCheckpoint(const SkinCheckpoint&) = delete;
    SkinCheckpoint& operator=(const SkinCheckpoint&) = delete;

    std::int64_t resumed_samples() const { return resumed_samples_; }  ///< samples that an earlier run has simulated; 0: it is not resumed
    /// Adds the force of the next block, which begins with sample `first`. Returns an error if the force so far differs from that of
    /// the earlier run, at the latest in the block in which the earlier run ended.
    Result<void> add_force(const SkinForce::Block&, std::int64_t first);
    /// For a block that an earlier run has simulated: appends its spikes. `end` is the index of the sample after the block.
    Result<void> replay(std::int64_t end, std::vector<Spike>&);
    /// Adds the spikes of a newly simulated block.
    Result<void> append(std::span<const Spike>);
    /// Writes everything to disk, so that a run can be resumed after the last block.
    Result<void> flush();
    /// Call at the end of the force. `samples`: its number of samples. Returns an error if an earlier run has simulated more.
    Result<void> finish(std::int64_t samples);
    /// Removes both files. Call it when the run is complete and its outputs have their final names.
    void remove_files();

private:
    SkinCheckpoint(std::string file, Skin& skin, RunFingerprint fingerprint)
        : file_(std::move(file)), spikes_file_(file_ + ".spikes"), skin_(skin), fingerprint_(std::move(fingerprint)) {}
    Result<void> check_file() const;
    Result<void> lock_spikes();
    Result<void> resume();
    Result<void> check_spikes(std::uint64_t checksum);
    Error system_error(const std::string& path) const;
    Error changed_force_error() const;
    std::string remedy() const;

    std::string file_, spikes_file_;
    Skin& skin_;
    RunFingerprint fingerprint_;
    FileHandle spikes_;  // locked while it is open
    std::int64_t resumed_samples_ = 0;
    std::uint64_t spike_count_ = 0;       // number of spikes in FILE.spikes
    std::uint64_t replayed_ = 0;          // number of these spikes that were read again
    Checksum spikes_sum_, force_sum_;     // of the spikes in FILE.spikes; of the force of this run so far
    std::uint64_t force_to_resumed_ = 0;  // checksum, from FILE, of the first `resumed_samples_` samples of force
};

/// Checksum of a file's contents, as used in a RunFingerprint.
Result<std::string> checksum_of_file(const std::string& path);

}  // namespace corpuscle
