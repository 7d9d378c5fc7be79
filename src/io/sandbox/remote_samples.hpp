#pragma once
// Samples that a helper program reads in a process of its own (helper_process.hpp).

#include "io/recording/samples.hpp"

namespace corpuscle {

/// The helper program for one file format.
struct HelperProgram {
    std::string program;  ///< name of the program: "corpuscle-hdf5"
    std::string library;  ///< the library's name, with which error messages begin: "the HDF5 library"
};

/// Starts the helper program, which reads the file at `path`. It runs until the samples are destroyed.
SamplesResult open_remote_samples(const std::string& path, const HelperProgram&, const TableOptions& = {});

/// The same with the program whose path is `program`.
SamplesResult open_remote_samples_with(const std::string& program, const std::string& path, const HelperProgram&, const TableOptions& = {});

}  // namespace corpuscle
