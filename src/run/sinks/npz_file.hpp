#pragma once
// Spikes as NumPy arrays, for SpikeInterface and for exact times.

#include "io/table/npz.hpp"
#include "run/sinks/file_sinks.hpp"

namespace corpuscle {

/// spikes.npz: the arrays that SpikeInterface's NpzSortingExtractor reads (unit_ids, num_segment, sampling_frequency, spike_indexes_seg0,
/// spike_labels_seg0), with one segment for each input. A unit is an afferent; its id is Spike::afferent_index. In addition: the
/// names unit_afferent and unit_channel, and spike_times_seg0, the exact times in s on the clock of the input. spike_indexes_seg0 counts
/// microseconds from the segment's first sample, which is finer than the timing of any nerve. The spikes are kept in memory until the end,
/// because the length of an array precedes its data.
class NpzFile final : public FileSink {
    OutputFile file_;
    NpzWriter npz_;
    std::vector<std::string> afferents_, channels_;  // of each afferent of all inputs
    std::vector<std::int64_t> indexes_, labels_;     // of the current segment
    std::vector<double> times_;                      // of the current segment, s
    std::int64_t segments_ = 0;                      // completed segments

public:
    static constexpr double ticks_per_second = 1e6;  ///< sampling_frequency; a tick is the unit of the indexes

    explicit NpzFile(OutputFile file) : file_(std::move(file)) {}
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    Result<void> end(const Input&, std::int64_t samples) override;
    std::vector<std::string> paths() const override { return {file_.path()}; }
    Result<void> commit() override;
};

}  // namespace corpuscle
