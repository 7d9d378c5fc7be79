#pragma once
// Samples that a helper program reads.

#include "io/samples.hpp"

namespace corpuscle {

/// The helper program for one file format.
struct Reader {
    std::string program;  ///< "corpuscle-hdf5"
    std::string library;  ///< the library's name, with which error messages begin: "the HDF5 library"
};

/// Starts the program, which reads this file until the samples are destroyed.
SamplesResult remote_samples(const std::string& path, const Reader&, const TableOptions& = {});

/// The same with the program at the path `program`.
SamplesResult remote_samples_by(const std::string& program, const std::string& path, const Reader&, const TableOptions& = {});

}  // namespace corpuscle
