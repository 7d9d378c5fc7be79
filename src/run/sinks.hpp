#pragma once
// All output formats of a run. Their list is in sinks.cpp.

#include "run/sinks/file_sink.hpp"

namespace corpuscle {

extern const OutputFormat psth_format;  // other files name it

/// In the order in which outputs are listed.
extern const std::span<const OutputFormat* const> output_formats;

}  // namespace corpuscle
