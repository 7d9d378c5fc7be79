#pragma once
// The complete force of a request: a stimulus by name, a channel of the recording that the engine keeps, or an array.

#include "page/kept_recording.hpp"
#include "page/object_reader.hpp"

namespace corpuscle::page {

struct PageForce {
    Clock clock;
    std::shared_ptr<const std::vector<double>> values;    ///< N
    std::vector<Phase> phases;                            ///< of a stimulus
    bool is_known = false;                                ///< the request has the values as an array
    std::uint64_t seed = 0;                               ///< of all random numbers of the request
    std::string source = "the force", channel = "force";  ///< names for messages
    RecordingQuality quality;                             ///< of the channel of a recording
};

/// Reads the key "seed", and "rate", "stimulus" and "stimulus_set", or "rate" and the array "force", or "channel". `recording`: the one
/// that the engine keeps; null if there is none.
Result<PageForce> read_force(ObjectReader&, const KeptRecording* recording);

}  // namespace corpuscle::page
