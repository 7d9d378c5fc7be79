#pragma once
// The messages that tell a helper program to write an HDF5 file.

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

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

}  // namespace corpuscle
