#pragma once
// The general metadata of an NWB file: who, where, when.

#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// Metadata by the names of NWB. An empty text or list is not written.
struct NwbMetadata {
    std::string session_description{}, identifier{};  ///< "": the writer of the file fills them in
    /// ISO 8601 with a time zone; the time 0 of all times in the file. The default suits recordings whose times count from 1970.
    std::string session_start_time = "1970-01-01T00:00:00+00:00";
    std::vector<std::pair<std::string, std::vector<std::string>>> general{};  ///< "experimenter": {"Doe, Jane"}, "lab": {"Touch"}
    std::vector<std::pair<std::string, std::string>> subject{};               ///< "subject_id": "m1"
};

/// Reads fields such as "session_start_time=2026-03-01T12:00:00+01:00", "experimenter=Doe, Jane" and "subject.species=Homo sapiens". The
/// fields that are lists, experimenter and keywords, may be given several times. `option` begins the messages.
Result<NwbMetadata> read_nwb_metadata(std::span<const std::string> fields, std::string_view option);

}  // namespace corpuscle
