#pragma once
// A single request about an HDF5 file, which a helper program answers.

#include "io/sandbox/helper_process.hpp"

namespace corpuscle {

/// Opens the file, registers it as an input, sends `request` to a helper program that offers the service `protocol`, and returns its
/// response.
Result<std::string> request_from_hdf5(const std::string& path, const std::string& protocol, const std::string& request);

}  // namespace corpuscle
