#pragma once
// Reads spike files: the CSV, NPZ and address events that Corpuscle writes, and spike files of other programs.

#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// A spike train and its names in the file. In files of other programs, the name of the unit or cluster is that of the afferent. The
/// channel is "" if the file names none.
struct NamedTrain {
    std::string afferent, channel;
    std::vector<double> times;  ///< of the spikes, s, in ascending order

    /// "sa1,ch3", or "sa1" without a channel.
    std::string name() const { return channel.empty() ? afferent : afferent + "," + channel; }
};

/// The columns of a table of spikes that the user requests: that of the spike times, and that which identifies the train. Each is given by
/// its name or its number (counted from 1). By default, a column is found by its heading.
struct SpikeColumns {
    std::optional<std::string> time = {}, train = {};
};

/// All trains of a file, sorted by channel and afferent; numbers in names are compared by value, so that "u2" is before "u10". These
/// formats are recognised by their first bytes:
///
/// - NPZ of Corpuscle, or of SpikeInterface, in which segments after the first become the channels "segment 2", "segment 3" ...
/// - address events of Corpuscle and AEDAT 2 (doc/events.md)
/// - NPY arrays of times in seconds
/// - NWB: the table of units. Each is named after the column `SpikeColumns::train`; by default after the columns afferent and channel of
///   Corpuscle, after unit_name, or after its id
///
/// Any other file is a text table with one row for each spike, or JSON with one record for each spike. It has a column of spike times
/// (time_s, t [ms], spike_times ...; in seconds if its heading has no unit). The columns afferent or unit (cluster, neuron ...) and channel
/// identify the train. A table with only a column of times needs no header; all its spikes are one train. Trains without spikes are
/// returned only for NWB and an NPZ of Corpuscle.
Result<std::vector<NamedTrain>> read_spikes(const std::string& path, const SpikeColumns& = {});

}  // namespace corpuscle
