#pragma once
// Reads spike files: Corpuscle's CSV, NPZ and address events, and spike files of other programs.

#include <optional>
#include <string>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

/// A spike train with its name in the file. In files of other programs the unit or cluster is the afferent, and the channel is "".
struct NamedTrain {
    std::string afferent, channel;
    std::vector<double> times;  ///< s, in order

    std::string name() const { return channel.empty() ? afferent : afferent + "," + channel; }
};

/// Text as a field of a CSV file, in quotes if necessary.
std::string quote_csv_field(const std::string& name);

/// Columns of a table of spikes, by name or number. By default they are found by their headings.
struct SpikeColumns {
    std::optional<std::string> time = {}, train = {};
};

/// All trains of a file, sorted by name; numbers in names are compared by value, so "u2" is before "u10". Formats recognised by their first
/// bytes:
///
/// - NPZ of Corpuscle or of SpikeInterface, where segments after the first become channels "segment 2" ...
/// - address events of Corpuscle and AEDAT 2 (doc/events.md)
/// - NPY arrays of times in seconds
///
/// Any other file is a text table, or JSON with one record for each spike. It has a column of times (time_s, t [ms], spike_times ...;
/// seconds if there is no unit). The columns afferent or unit (cluster, neuron ...) and channel identify the train. A single column of
/// times needs neither these nor a header. Only an NPZ of Corpuscle contains trains without spikes.
Result<std::vector<NamedTrain>> read_spikes(const std::string& path, const SpikeColumns& = {});

}  // namespace corpuscle
