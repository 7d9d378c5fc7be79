#pragma once
// Output files of a run: spikes and probes, written block by block.

#include <fmt/format.h>

#include "io/output/output_file.hpp"
#include "run/afferent_run.hpp"

namespace corpuscle {

/// A sink that writes files. The files get their final names in commit().
class FileSink : public ResponseSink {
public:
    virtual std::vector<std::string> paths() const = 0;  ///< final paths of the files
    virtual Result<void> commit() = 0;
};

/// Name and channel of each afferent of an input as two CSV fields: "sa1,press".
std::vector<std::string> afferent_csv_names(const Input&);

/// Path of the output file of an input: DIR/probes.csv for index 0, DIR/probes-2.csv for index 1.
std::string numbered_path(const std::string& directory, std::string_view name, std::string_view extension, std::size_t index);

/// spikes.csv: afferent,channel,time_s; input after input, each in order of time. Times are on the clock of the input, to the nanosecond.
class SpikesFile final : public FileSink {
    OutputFile file_;
    std::vector<std::string> names_;  // "sa1,press" of each afferent of the current input
    fmt::memory_buffer text_;

public:
    explicit SpikesFile(OutputFile file);
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    std::vector<std::string> paths() const override { return {file_.path()}; }
    Result<void> commit() override { return file_.commit(); }
};

/// probes.csv: one row for each sample of the first input, with time_s, then the force of each channel, then the probes of each afferent on
/// each channel. A second input is written to probes-2.csv.
class ProbesFile final : public FileSink {
    std::string directory_;
    std::vector<OutputFile> files_;  // one for each input so far
    fmt::memory_buffer text_;

public:
    explicit ProbesFile(std::string directory) : directory_(std::move(directory)) {}
    bool wants_probes() const override { return true; }
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    std::vector<std::string> paths() const override;
    Result<void> commit() override;
};

}  // namespace corpuscle
