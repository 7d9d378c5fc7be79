#pragma once
// A helper program's life: it confines itself, opens the samples, and answers requests for rows until the other end is closed.

#include <functional>

#include "io/samples.hpp"

namespace corpuscle {

/// Opens the samples in descriptor `file`; `path` is for messages.
using OpenSamples = std::function<SamplesResult(int file, const std::string& path, const TableOptions&)>;

/// From the first request on `socket` until the last.
void serve(int socket, int file, const OpenSamples&);

/// The program's main; `kind` says what it reads, to a person who starts it by hand.
int helper_main(int argc, char** argv, const char* kind, const OpenSamples&);

}  // namespace corpuscle
