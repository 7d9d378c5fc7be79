#pragma once
// Checkpoints of a skin run, so that it can be killed and resumed. FILE holds the skin's state at some sample, FILE.spikes all spikes
// before it. The same command replays these spikes and continues, so every output is the same as without the interruption.

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "signal/checksum.hpp"
#include "study/skin_run.hpp"

namespace corpuscle {

/// The inputs that determine a run's response, by name: {"--scale", "0.02"}. Checksums of files are included under names that begin with
/// "contents of".
using RunFingerprint = std::vector<std::pair<std::string, std::string>>;

class SkinCheckpoint final : public SkinRunLog {
public:
    /// For a skin that has not started. Resumes it if FILE exists. Rejects a checkpoint of another skin or run and names the difference.
    /// Also rejects a damaged file, one in use by another process, and a file that is not a checkpoint, and leaves it unchanged.
    static Result<std::unique_ptr<SkinCheckpoint>> open(const std::string& file, Skin&, RunFingerprint);
    ~SkinCheckpoint() override;

    std::int64_t resumed_samples() const override { return resumed_samples_; }
    Result<void> add_force(const SkinForce::Block&, std::int64_t first) override;
    Result<void> replay(std::int64_t end, std::vector<Spike>&) override;
    Result<void> append(std::span<const Spike>) override;
    Result<void> flush() override;
    Result<void> finish(std::int64_t samples) override;
    /// Removes both files. Call it when the run is complete and its outputs have their final names.
    void remove_files();

private:
    SkinCheckpoint(std::string file, Skin& skin, RunFingerprint fingerprint)
        : file_(std::move(file)), spikes_file_(file_ + ".spikes"), skin_(skin), fingerprint_(std::move(fingerprint)) {}
    Result<void> check_file() const;
    Result<void> lock_spikes();
    Result<void> check_spikes_header() const;
    Result<void> resume();
    Result<void> check_spikes(std::uint64_t checksum);
    Error system_error(const std::string& path) const;
    Error changed_force_error() const;
    std::string remedy() const;

    std::string file_, spikes_file_;
    Skin& skin_;
    RunFingerprint fingerprint_;
    std::FILE* spikes_ = nullptr;  // locked while it is open
    std::int64_t resumed_samples_ = 0;
    std::uint64_t spike_count_ = 0;  // spikes written
    std::uint64_t replayed_ = 0;     // spikes of these that were read again
    Checksum spikes_sum_, force_sum_;
    std::uint64_t force_to_resumed_ = 0;  // checksum of the force before `resumed_samples_`
    std::vector<Spike> read_ahead_;       // a spike that was read but belongs to a later block
};

/// Checksum of a file's contents, as used in a RunFingerprint.
Result<std::string> checksum_of_file(const std::string& path);

}  // namespace corpuscle
