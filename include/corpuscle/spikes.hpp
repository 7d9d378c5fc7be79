#pragma once
// Spike trains in files: those of Corpuscle, and of other programs.

#include <string>
#include <vector>

#include "corpuscle/error.hpp"

namespace corpuscle {

/// A spike train of a file.
struct SpikeTrain {
    std::string afferent;       ///< or unit, cluster, neuron; "" if the file names none
    std::string channel;        ///< "" if the file names none
    std::vector<double> times;  ///< s, ascending
};

/// Reads all trains of a file in any format that `corpuscle compare` reads (doc/events.md). `time_column` and `train_column` choose the
/// columns of a table by name or number; "": by their headings. Throws InputError with file and line.
CORPUSCLE_API std::vector<SpikeTrain> read_spike_trains(const std::string& path, const std::string& time_column = "",
                                                        const std::string& train_column = "");

}  // namespace corpuscle
