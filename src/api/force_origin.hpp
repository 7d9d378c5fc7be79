#pragma once

#include <deque>

#include "core/force_source.hpp"
#include "corpuscle/force.hpp"

namespace corpuscle {

/// The properties of a source apart from its samples.
struct ForceOrigin {
    std::vector<Channel> channels = {};
    std::vector<Phase> phases = {};
    double cycle_frequency = 0;  ///< Hz
    std::string description = {};
    std::vector<MetadataEntry> metadata = {};
    std::vector<std::string> notes = {};
    RecordingQuality quality = {};
    bool has_unit = false;               ///< the unit of the recording was given
    std::deque<std::string> names = {};  ///< of a loaded origin: the texts to which `quality` refers
};

}  // namespace corpuscle
