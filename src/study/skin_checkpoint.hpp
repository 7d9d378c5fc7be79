#pragma once
// A run of a skin that can be killed and gone on with. FILE holds the skin's state at some sample, FILE.spikes all spikes up to then: the
// same command reports them again and goes on, so every output is what it would have been.

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "signal/checksum.hpp"
#include "study/skin_run.hpp"

namespace corpuscle {

/// What decides a run's answer, by name: {"--scale", "0.02"}. Checksums of files are among it; their names begin with "contents of".
using RunFingerprint = std::vector<std::pair<std::string, std::string>>;

class SkinCheckpoint final : public SkinSpool {
public:
    /// Of a skin that has not begun; resumes it if FILE is there. Refuses a checkpoint of another skin or run, and names what differs; a
    /// damaged one; one that another process uses; and files that no checkpoint wrote, which it leaves alone.
    static Result<std::unique_ptr<SkinCheckpoint>> open(const std::string& file, Skin&, RunFingerprint);
    ~SkinCheckpoint() override;

    std::int64_t step() const override { return resumed_; }
    Result<void> force(const SkinForce::Block&, std::int64_t first) override;
    Result<void> told(std::int64_t end, std::vector<Spike>&) override;
    Result<void> answered(std::span<const Spike>) override;
    Result<void> keep() override;
    Result<void> ended(std::int64_t samples) override;
    /// The run is over, and its outputs are in their places: removes both files.
    void done();

private:
    SkinCheckpoint(std::string file, Skin& skin, RunFingerprint fingerprint)
        : file_(std::move(file)), spikes_file_(file_ + ".spikes"), skin_(skin), fingerprint_(std::move(fingerprint)) {}
    Result<void> check_file() const;
    Result<void> lock_spikes();
    Result<void> check_spikes_header() const;
    Result<void> resume();
    Result<void> check_spikes(std::uint64_t checksum);
    Error broken(const std::string& path) const;
    Error another_force() const;
    std::string remedy() const;

    std::string file_, spikes_file_;
    Skin& skin_;
    RunFingerprint fingerprint_;
    std::FILE* spikes_ = nullptr;  // locked as long as it is open
    std::int64_t resumed_ = 0;
    std::uint64_t count_ = 0;  // of spikes written
    std::uint64_t told_ = 0;   // of them, read again
    Checksum spikes_sum_, force_sum_;
    std::uint64_t force_to_resumed_ = 0;  // checksum of the force up to `resumed_`
    std::vector<Spike> ahead_;            // read, and of a later block
};

/// Checksum of a file's contents, as a RunFingerprint has it.
Result<std::string> contents_of(const std::string& path);

}  // namespace corpuscle
