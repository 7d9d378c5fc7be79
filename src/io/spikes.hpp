#pragma once
// Files of spikes, read: our own CSV, NPZ and address events, and those of others that are alike.

#include <optional>
#include <string>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

/// The spikes of one unit, as a file names it. Other people's units are numbers or words: they stand as afferents, without a channel.
struct NamedTrain {
    std::string afferent, channel;
    std::vector<double> times;  ///< s, in order

    std::string name() const { return channel.empty() ? afferent : afferent + "," + channel; }
};

/// A name as a field of a CSV file.
std::string csv_field(const std::string& name);

/// Which columns of a table of spikes are meant, by name or number; else those that are called so.
struct SpikeColumns {
    std::optional<std::string> time = {}, unit = {};
};

/// Every train of a file, in the order of their names, numbers in them by value. An NPZ is recognised by its first bytes: ours,
/// or any that SpikeInterface writes (a unit's segments after the first are its channels "segment 2" ...); so are address events, ours
/// and AEDAT 2 (doc/events.md), and NumPy's arrays of times in seconds. Anything else is a table of text, or JSON with a record a spike: a
/// column of times (time_s, t [ms], spike_times ...; seconds if it does not say) and, to tell trains apart, columns called afferent or
/// unit (cluster, neuron ...), and channel; only a lone column of times needs none, nor a header. A train without spikes stands only in
/// an NPZ of ours.
Result<std::vector<NamedTrain>> read_spikes(const std::string& path, const SpikeColumns& = {});

}  // namespace corpuscle
