#pragma once
// Samples read by a helper program.

#include "io/samples.hpp"

namespace corpuscle {

/// The helper program that reads a kind of file.
struct Reader {
    std::string program;  ///< "corpuscle-hdf5"
    std::string library;  ///< begins a sentence about what went wrong: "the HDF5 library"
};

/// Starts the program; it reads this file until the samples are destroyed.
SamplesResult remote_samples(const std::string& path, const Reader&, const TableOptions& = {});

/// The same through the program at this path.
SamplesResult remote_samples_by(const std::string& program, const std::string& path, const Reader&, const TableOptions& = {});

}  // namespace corpuscle
