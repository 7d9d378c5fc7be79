#pragma once
// Chooses the force among the time series of an NWB file.

#include "hdf5_file.hpp"

namespace corpuscle {

/// True for an NWB file.
bool is_nwb(hid_t file);

/// The index of the only series in newtons; if there is none, of the only series of numbers. Several are an error that lists them. nullopt
/// if the file has no series of numbers.
Result<std::optional<std::size_t>> choose_force_series(hid_t file, std::span<const ArrayInfo> arrays, const std::string& path);

}  // namespace corpuscle
