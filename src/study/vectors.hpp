#pragma once
// What a digital afferent computed, word by word, so that hardware built to doc/fixed-point.md can be checked against it.

#include <fmt/format.h>

#include "io/output.hpp"
#include "model/sensor/digital.hpp"
#include "study/files.hpp"

namespace corpuscle {

/// vectors-AFFERENT.csv: the constants as comments, then a row a conversion; a second channel makes vectors-AFFERENT-2.csv ...
/// rom-AFFERENT.csv: the table from codes to words of force. Afferents without a converter make none.
class VectorsFile final : public WrittenFile {
    struct Unit {
        std::size_t afferent;
        OutputFile file;
        State state;
    };
    std::string directory_;
    std::vector<std::unique_ptr<Digital>> digital_;  // of each afferent, or none; of the input at work
    std::vector<std::optional<Unit>> units_;         // of the input at work
    std::vector<OutputFile> whole_;
    std::vector<int> made_;  // files of each afferent
    std::vector<std::string> paths_;

    Result<void> make_afferents(const Input&);
    Result<void> open(const Input&, std::size_t unit);

public:
    explicit VectorsFile(std::string directory) : directory_(std::move(directory)) {}
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const Answered&) override;
    Result<void> end(const Input&, std::int64_t samples) override;
    std::vector<std::string> paths() const override { return paths_; }
    Result<void> commit() override;
};

}  // namespace corpuscle
