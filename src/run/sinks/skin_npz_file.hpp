#pragma once
// Spikes of a skin as NumPy arrays.

#include "io/table/npz.hpp"
#include "run/sinks/skin_file_sink.hpp"

namespace corpuscle {

/// spikes.npz: the arrays of NpzFile (npz_file.hpp) with one segment. unit_ids are the values of afferent_index in afferents.csv.
/// unit_channel contains the names of the regions, unit_x_m and unit_y_m the positions of the afferents. The spikes are kept in memory
/// until the end.
class SkinNpzFile final : public SkinFileSink {
    OutputFile file_;
    NpzWriter npz_;
    std::vector<std::int64_t> indexes_, labels_;
    std::vector<double> times_;  // s

    void put(const Clock&, std::span<const Spike>);

public:
    explicit SkinNpzFile(OutputFile file) : file_(std::move(file)) {}
    Result<void> block(const SkinInput&, const SkinRunBlock&) override;
    Result<void> end(const SkinInput&, std::int64_t samples, std::span<const Spike> last) override;
    std::vector<std::string> paths() const override { return {file_.path()}; }
    Result<void> commit() override;
};

}  // namespace corpuscle
