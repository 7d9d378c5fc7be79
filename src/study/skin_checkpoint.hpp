#pragma once
// A run of a skin that can be killed and gone on with. FILE holds the skin's state at some sample, FILE.spikes all spikes that were told up
// to then: the same command tells them again and goes on, so every output is what it would have been.

#include "study/skin_run.hpp"

namespace corpuscle {

class SkinCheckpoint final : public SkinSpool {
public:
    /// Of a skin that has not begun; resumes it if FILE is there. Refuses a state of another skin or another force (`likeness`: the
    /// command's words that say which).
    static Result<std::unique_ptr<SkinCheckpoint>> open(const std::string& file, Skin&, const std::string& likeness);
    ~SkinCheckpoint() override;

    std::int64_t step() const override { return resumed_; }
    Result<void> told(std::int64_t end, std::vector<Spike>&) override;
    Result<void> answered(std::span<const Spike>) override;
    Result<void> keep() override;
    /// The run is over, and its outputs are in their places: takes both files away.
    void done();

private:
    SkinCheckpoint(std::string file, Skin& skin, std::string likeness)
        : file_(std::move(file)), skin_(skin), likeness_(std::move(likeness)) {}
    Result<void> resume();
    Error broken(const std::string& path) const;

    std::string file_;
    Skin& skin_;
    std::string likeness_;
    std::FILE* spikes_ = nullptr;
    std::int64_t resumed_ = 0;
    std::uint64_t count_ = 0;   // of spikes written
    std::vector<Spike> ahead_;  // read, and of a later block
};

}  // namespace corpuscle
