#pragma once
// Writes output files.

#include <string>

#include "io/output/output_file.hpp"

namespace corpuscle {

/// Writes the complete content of a file and renames the file to its final name.
Result<void> write_and_commit(OutputFile&, const std::string& text);
Result<void> write_file(const std::string& path, const std::string& text);

}  // namespace corpuscle
