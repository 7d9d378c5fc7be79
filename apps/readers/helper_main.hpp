#pragma once
// The main loop of a helper program: it confines itself, opens the samples, and serves requests for rows until the socket is closed.

#include <functional>

#include "io/recording/samples.hpp"

namespace corpuscle {

/// Opens the samples of the file that is open as descriptor `file`; `path` is for messages.
using OpenSamples = std::function<SamplesResult(int file, const std::string& path, const TableOptions&)>;

/// Serves the requests of the program `corpuscle` on `socket`: one that opens the samples of descriptor `file`, then those for rows.
void serve(int socket, int file, const OpenSamples&);

/// The main function of a helper program. `kind` names the file format in the message to a user who starts the program by hand.
int helper_main(int argc, char** argv, const char* kind, const OpenSamples&);

}  // namespace corpuscle
