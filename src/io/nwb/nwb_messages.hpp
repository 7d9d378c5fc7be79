#pragma once
// The messages in which a helper program returns the units or the trials of an NWB file.

#include <string>
#include <tuple>
#include <vector>

namespace corpuscle {

/// The request to read the units of an NWB file.
struct UnitsRequest {
    std::string path;     ///< for error messages only: the file is open already
    std::string label{};  ///< the column that names the units; "": found by its name
};
inline auto byte_fields(UnitsRequest& r) { return std::tie(r.path, r.label); }

/// A unit of an NWB file.
struct NwbUnit {
    std::string name{}, channel{};
    std::vector<double> times{};  ///< s
};
inline auto byte_fields(NwbUnit& u) { return std::tie(u.name, u.channel, u.times); }

/// The request to read the trials of an NWB file.
struct TrialsRequest {
    std::string path;                   ///< for error messages only: the file is open already
    std::vector<std::string> labels{};  ///< the first of these names (in any case) that a column has is the column of the labels
    bool needs_label = false;           ///< true: a file without such a column is an error
};
inline auto byte_fields(TrialsRequest& r) { return std::tie(r.path, r.labels, r.needs_label); }

struct NwbTrial {
    double start = 0, stop = 0;  ///< s
    std::string label{};
};
inline auto byte_fields(NwbTrial& t) { return std::tie(t.start, t.stop, t.label); }

/// The trials of an NWB file, in the order of the file. Their times are not checked.
struct NwbTrialTable {
    std::vector<NwbTrial> trials{};
    std::string label{};                ///< the name of the column of the labels; "": there is none
    std::vector<std::string> unused{};  ///< the names of all columns that were not read
};
inline auto byte_fields(NwbTrialTable& t) { return std::tie(t.trials, t.label, t.unused); }

}  // namespace corpuscle
