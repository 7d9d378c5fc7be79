#pragma once
// Test vectors: each word that a digital afferent (an afferent behind a converter) computes, to verify hardware built to
// doc/fixed-point.md.

#include <fmt/format.h>

#include "io/output/output_file.hpp"
#include "model/sensor/digital_afferent.hpp"
#include "run/sinks/file_sinks.hpp"

namespace corpuscle {

/// Writes for each digital afferent:
///
/// vectors-AFFERENT.csv: the constants as comments, then one row for each conversion on the first channel of the first input. Each further
/// channel, also of further inputs, has its own file: vectors-AFFERENT-2.csv, vectors-AFFERENT-3.csv
///
/// rom-AFFERENT.csv: the table from codes of the converter to words of force.
class TestVectorsFile final : public FileSink {
    /// The vectors of one afferent on one channel of the current input.
    struct AfferentFile {
        std::size_t plan_index;
        OutputFile file;
        State state;  // of the afferent, which this sink simulates itself
    };
    std::string directory_;
    std::vector<std::unique_ptr<DigitalAfferent>> digital_;  // for each plan, at the sample rate of the current input; null if not digital
    std::vector<std::optional<AfferentFile>> afferent_files_;  // for each afferent of the current input; no value if not digital
    std::vector<OutputFile> complete_files_;                   // not yet committed
    std::vector<int> file_counts_;                             // for each plan: number of vectors files so far
    std::vector<std::string> paths_;

    Result<void> make_afferents(const Input&);
    Result<void> open_vectors_file(const Input&, std::size_t afferent_index);

public:
    explicit TestVectorsFile(std::string directory) : directory_(std::move(directory)) {}
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    Result<void> end(const Input&, std::int64_t samples) override;
    std::vector<std::string> paths() const override { return paths_; }
    Result<void> commit() override;
};

}  // namespace corpuscle
