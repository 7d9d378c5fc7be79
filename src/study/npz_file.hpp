#pragma once
// Spikes as NumPy arrays, for SpikeInterface and for exact times.

#include "io/npz.hpp"
#include "study/file_sinks.hpp"

namespace corpuscle {

/// spikes.npz: the arrays that SpikeInterface's NpzSortingExtractor reads (unit_ids, num_segment, sampling_frequency, spike_indexes_seg0,
/// spike_labels_seg0), with one segment for each input. In addition unit_afferent, unit_channel, and exact times on the clock of the
/// recording, spike_times_seg0. The indexes count microseconds from the segment's first sample: finer than the timing of any nerve,
/// and integers that are easy to read. The spikes are kept in memory until the end, because the length of an array precedes its data.
class NpzFile final : public FileSink {
    OutputFile file_;
    NpzWriter npz_;
    std::vector<std::string> afferents_, channels_;  // of each afferent of all inputs
    std::vector<std::int64_t> indexes_, labels_;
    std::vector<double> times_;  // s
    std::int64_t segments_ = 0;

public:
    static constexpr double ticks_per_second = 1e6;

    explicit NpzFile(OutputFile file) : file_(std::move(file)) {}
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    Result<void> end(const Input&, std::int64_t samples) override;
    std::vector<std::string> paths() const override { return {file_.path()}; }
    Result<void> commit() override;
};

}  // namespace corpuscle
