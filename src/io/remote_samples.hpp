#pragma once
// Samples that a helper program reads.

#include "io/samples.hpp"

namespace corpuscle {

/// The helper program for one file format.
struct HelperProgram {
    std::string program;  ///< "corpuscle-hdf5"
    std::string library;  ///< the library's name, with which error messages begin: "the HDF5 library"
};

/// Starts the program, which opens this file. It runs until the samples are destroyed.
SamplesResult open_remote_samples(const std::string& path, const HelperProgram&, const TableOptions& = {});

/// The same with the program at the path `program`.
SamplesResult open_remote_samples_with(const std::string& program, const std::string& path, const HelperProgram&, const TableOptions& = {});

}  // namespace corpuscle
