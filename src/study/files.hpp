#pragma once
// The answer as files: spikes and traces, written as they come.

#include <fmt/format.h>

#include "io/output.hpp"
#include "study/respond.hpp"

namespace corpuscle {

/// spikes.csv: afferent,channel,time_s; in order of time, input after input. Times to the nanosecond.
class SpikesFile final : public Listener {
    OutputFile file_;
    std::vector<std::string> names_;  // "sa1,press" of each unit of the input at work
    fmt::memory_buffer text_;

public:
    explicit SpikesFile(OutputFile file);
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const Answered&) override;
    Result<void> commit() { return file_.commit(); }
};

/// traces.csv: time_s, each channel's force, each afferent's probes on it; a row a sample. A second input makes traces-2.csv ...
class TracesFile final : public Listener {
    std::string directory_;
    std::vector<OutputFile> files_;
    fmt::memory_buffer text_;

public:
    std::vector<std::string> paths() const;
    explicit TracesFile(std::string directory) : directory_(std::move(directory)) {}
    bool wants_probes() const override { return true; }
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const Answered&) override;
    Result<void> commit();
};

}  // namespace corpuscle
