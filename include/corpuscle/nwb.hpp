#pragma once
// Responses as files of Neurodata Without Borders (doc/formats.md).

#include "corpuscle/trials.hpp"

namespace corpuscle {

/// Contents of an NWB file besides the response.
struct NwbOptions {
    std::vector<std::string> fields = {};  ///< "session_start_time=2026-03-01T12:00:00+01:00", "experimenter=Doe, Jane"
    std::string source = {};               ///< how the response was computed, such as a command; "": unknown
    bool is_measured = false;              ///< the force was measured
    double resolution = 1e-9;              ///< s, of the spike times; the sample period if Simulation::sampled is set
    std::uint64_t seed = 0;                ///< Simulation::seed
    std::vector<Epoch> trials = {};
    bool overwrite = false;  ///< replace an existing file
};

/// Writes the response, and its force if it is not null. That of a skin under a touch is Response::skin_force. Throws InputError for a response that NWB cannot express, such as two spikes of an
/// afferent at the same time, and for a file that exists.
CORPUSCLE_API void write_nwb(const std::string& path, const Response&, const ForceView* force = nullptr, const NwbOptions& = {});

}  // namespace corpuscle
