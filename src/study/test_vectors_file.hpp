#pragma once
// Test vectors: each word that a digital afferent computed, to verify hardware built to doc/fixed-point.md.

#include <fmt/format.h>

#include "io/output_file.hpp"
#include "model/sensor/digital_afferent.hpp"
#include "study/file_sinks.hpp"

namespace corpuscle {

/// vectors-AFFERENT.csv: the constants as comments, then one row for each conversion. A second channel gives vectors-AFFERENT-2.csv ...
///
/// rom-AFFERENT.csv: the table from codes to force words. Afferents without a converter have no such files.
class TestVectorsFile final : public FileSink {
    struct AfferentFile {
        std::size_t plan_index;
        OutputFile file;
        State state;
    };
    std::string directory_;
    std::vector<std::unique_ptr<DigitalAfferent>> digital_;    // of the current input, for each plan; null if it is not digital
    std::vector<std::optional<AfferentFile>> afferent_files_;  // of the current input
    std::vector<OutputFile> complete_files_;
    std::vector<int> file_counts_;  // number of files for each plan
    std::vector<std::string> paths_;

    Result<void> make_afferents(const Input&);
    Result<void> open(const Input&, std::size_t afferent_index);

public:
    explicit TestVectorsFile(std::string directory) : directory_(std::move(directory)) {}
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    Result<void> end(const Input&, std::int64_t samples) override;
    std::vector<std::string> paths() const override { return paths_; }
    Result<void> commit() override;
};

}  // namespace corpuscle
