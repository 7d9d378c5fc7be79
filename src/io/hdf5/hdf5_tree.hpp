#pragma once
// All datasets of an HDF5 file, read through a helper program; and the messages of that program.

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// A dataset of numbers or of texts.
struct Hdf5Array {
    std::string path{};                  ///< in the file: "/node/nodes/lif/tau"
    std::vector<std::uint64_t> shape{};  ///< empty: a scalar
    bool is_text = false;
    bool is_other = false;          ///< it has neither numbers nor texts, and its elements were not read
    std::vector<double> numbers{};  ///< in row-major order; empty for texts
    std::vector<std::string> texts{};

    std::uint64_t element_count() const { return is_text ? texts.size() : numbers.size(); }
};
inline auto byte_fields(Hdf5Array& a) { return std::tie(a.path, a.shape, a.is_text, a.is_other, a.numbers, a.texts); }

/// Requests all datasets. `path` is for error messages only: the file is open already.
struct TreeRequest {
    std::string path;
    std::string skipped{};  ///< the name of groups and datasets that are not read, such as "metadata"; "": none
};
inline auto byte_fields(TreeRequest& r) { return std::tie(r.path, r.skipped); }

/// Decodes the response of the helper program; `path` is the path of the file, for messages. Any bytes give datasets or an error. The
/// number of elements of each dataset is that of its shape.
Result<std::vector<Hdf5Array>> decode_tree(const std::string&, const std::string& path);

/// Reads all datasets of the file except those in groups of the name `skipped`. Returns an error if the file cannot be read, is damaged, or
/// has more than 2^25 elements.
Result<std::vector<Hdf5Array>> read_hdf5_tree(const std::string& path, const std::string& skipped = "");

}  // namespace corpuscle
