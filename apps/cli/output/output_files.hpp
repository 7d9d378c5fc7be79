#pragma once
// Output files: the name of a report page, and writing a complete file.

#include <string>

#include "io/output/output_file.hpp"

namespace corpuscle {

/// Writes the complete content of a file and renames the file to its final name.
Result<void> write_and_commit(OutputFile&, const std::string& text);
Result<void> write_file(const std::string& path, const std::string& text);

/// Returns an error if a report page is requested by a name that does not end in .html. "": none, or the default name.
Result<void> check_page_name(const std::string& name);

}  // namespace corpuscle
