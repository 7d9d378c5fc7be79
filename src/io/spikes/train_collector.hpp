#pragma once
// Collects the spike trains of a file by name, and declares the readers of the spike formats.

#include <cstddef>
#include <map>

#include "io/spikes/spike_files.hpp"

namespace corpuscle {

class TrainCollector {
    std::map<std::pair<std::string, std::string>, std::vector<double>> trains_;  // by afferent and channel

public:
    /// The spike times of a train, in s, to which spikes are appended. The reference remains valid when other trains are added.
    std::vector<double>& train(const std::string& afferent, const std::string& channel) { return trains_[{afferent, channel}]; }
    /// All trains, sorted by channel and afferent, with their spikes in order of time.
    std::vector<NamedTrain> sorted() &&;
};

// The readers of the formats. Use read_spikes() in spike_files.hpp, which recognises the format.

Result<std::vector<NamedTrain>> read_text_spikes(const std::string& path, const SpikeColumns&);
Result<std::vector<NamedTrain>> read_npy_spikes(const std::string& path, const SpikeColumns&);
Result<std::vector<NamedTrain>> read_npz_spikes(const std::string& path);
Result<std::vector<NamedTrain>> read_nwb_spikes(const std::string& path, const SpikeColumns&);
Result<std::vector<NamedTrain>> read_aer_spikes(const std::string& path);
Result<std::vector<NamedTrain>> read_aedat2_spikes(const std::string& path);

struct ResolvedSpikeColumns {
    std::size_t time = 0;                                    ///< index of the column of spike times
    double seconds_per_unit = 1;                             ///< the unit of the spike times, in s
    std::optional<std::size_t> afferent = {}, channel = {};  ///< indices of the columns that identify the train; nullopt: no such column
};

/// Finds the columns by their headings, or as the user requests in `wanted`. `headings` has one element for each column, "" if the file has
/// no header. A missing or wrong column is an error. If the error concerns one column, sets `column` to its number, counted from 1.
Result<ResolvedSpikeColumns> find_spike_columns(const std::vector<std::string>& headings, const SpikeColumns& wanted, std::size_t& column);

}  // namespace corpuscle
