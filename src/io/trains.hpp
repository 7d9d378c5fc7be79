#pragma once
// Collects the spike trains of a file by name, and declares the readers of the spike formats.

#include <map>
#include <utility>

#include "io/spikes.hpp"

namespace corpuscle {

class Trains {
    std::map<std::pair<std::string, std::string>, std::vector<double>> all_;

public:
    std::vector<double>& of(const std::string& afferent, const std::string& channel) { return all_[{afferent, channel}]; }
    std::vector<NamedTrain> in_order() &&;
};

Result<std::vector<NamedTrain>> read_text_spikes(const std::string& path, const SpikeColumns&);
Result<std::vector<NamedTrain>> read_npy_spikes(const std::string& path, const SpikeColumns&);
Result<std::vector<NamedTrain>> read_npz_spikes(const std::string& path);
Result<std::vector<NamedTrain>> read_aer_spikes(const std::string& path);
Result<std::vector<NamedTrain>> read_aedat2_spikes(const std::string& path);

}  // namespace corpuscle
