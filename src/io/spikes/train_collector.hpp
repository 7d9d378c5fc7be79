#pragma once
// Collects the spike trains of a file by name, and declares the readers of the spike formats.

#include <map>
#include <utility>

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
Result<std::vector<NamedTrain>> read_aer_spikes(const std::string& path);
Result<std::vector<NamedTrain>> read_aedat2_spikes(const std::string& path);

}  // namespace corpuscle
