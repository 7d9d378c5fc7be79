#pragma once
// The messages that tell a helper program to write an HDF5 file, and those in which it returns the units or trials of an NWB file.

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

enum class Hdf5Type : std::uint8_t { real, int32, int64, uint64, text, reference };

/// An attribute of a group or dataset.
struct Hdf5Attribute {
    std::string name;
    Hdf5Type type = Hdf5Type::text;    ///< text, real, int32, or a reference to the object whose path is the text
    bool is_list = false;              ///< of a text: one dimension instead of a scalar
    std::vector<std::string> texts{};  ///< one, or those of a list
    double number = 0;
};
inline auto byte_fields(Hdf5Attribute& a) { return std::tie(a.name, a.type, a.is_list, a.texts, a.number); }

/// One step of writing a file. Steps must be in order: a group before its members, a dataset before a reference to it.
struct Hdf5Step {
    enum class Kind : std::uint8_t { group, dataset, append, attributes, finish };
    Kind kind = Kind::group;
    std::string path{};                  ///< of the group or dataset
    Hdf5Type type = Hdf5Type::real;      ///< of a dataset: not a reference
    std::vector<std::uint64_t> shape{};  ///< of a dataset; empty: a scalar
    bool is_growing = false;             ///< the first dimension of the dataset begins at 0 and grows with each `append`
    std::vector<Hdf5Attribute> attributes{};
    std::vector<std::string> texts{};  ///< the elements of a dataset of texts
    std::vector<char> bytes{};         ///< the elements of a dataset of numbers, or those that are appended
};
inline auto byte_fields(Hdf5Step& s) { return std::tie(s.kind, s.path, s.type, s.shape, s.is_growing, s.attributes, s.texts, s.bytes); }

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

std::string encode(const Hdf5Step&);
std::string encode(const UnitsRequest&);
std::string encode(const TrialsRequest&);
// Return false if the message is not such a request.
bool decode(const std::string&, Hdf5Step&);
bool decode(const std::string&, UnitsRequest&);
bool decode(const std::string&, TrialsRequest&);

// The response with the units or trials, or with only success. An error is encoded as in io/sandbox/remote_samples.hpp.
std::string encode(const std::vector<NwbUnit>&);
std::string encode(const NwbTrialTable&);
std::string encode_success();
// Decode a response; `path` is the path of the file, for messages. Any bytes give units or trials, or an error.
Result<std::vector<NwbUnit>> decode_units(const std::string&, const std::string& path);
Result<NwbTrialTable> decode_trials(const std::string&, const std::string& path);

}  // namespace corpuscle
