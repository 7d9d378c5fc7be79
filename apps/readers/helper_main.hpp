#pragma once
// The helper programs: the main loop, which they share, and the reader of each file format. Only helper programs call the readers, because
// damaged files have crashed the libraries of the formats, or could make them loop forever.

#include "io/recording/samples.hpp"

namespace corpuscle {

/// Opens the samples of the file that is open as descriptor `file`; `path` is for messages.
using OpenSamples = std::function<SamplesResult(int file, const std::string& path, const TableOptions&)>;

/// Opens the dataset of an HDF5 file that the options request, or the only one that can be a recording.
SamplesResult open_hdf5_samples(int file, const std::string& path, const TableOptions&);
/// Opens a sound file with libsndfile. The options are not used.
SamplesResult open_sound_samples(int file, const std::string& path, const TableOptions&);

/// Forbids this process new privileges, descriptors, files, programs, connections and core dumps, and lets it use at most `memory` bytes
/// more address space than now. Existing lower limits stay. Landlock and seccomp are used if the kernel has them. Descriptors up to
/// `last_descriptor` stay usable.
void confine(int last_descriptor, std::uint64_t memory);

/// Serves the requests of the program `corpuscle` on `socket`: one that opens the samples of descriptor `file`, then those for rows.
void serve(int socket, int file, const OpenSamples&);

/// The main function of a helper program: it confines itself, opens the samples, and serves requests for rows until the socket is closed.
/// `kind` names the file format in the message to a user who starts the program by hand.
int helper_main(int argc, char** argv, const char* kind, const OpenSamples&);

}  // namespace corpuscle
