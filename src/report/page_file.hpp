#pragma once
// Report pages as files.

#include <string>

#include "core/error.hpp"

namespace corpuscle {

/// Returns an error if a report page is requested by a name that does not end in .html. "": none, or the default name.
Result<void> check_page_name(const std::string& name);

/// Returns an error if a page may not be written to this path, because there is a file that is not a page of this program.
Result<void> check_page_path(const std::string& path);

/// Writes a page, which replaces only a page of this program and an empty file.
Result<void> write_page(const std::string& path, const std::string& page);

}  // namespace corpuscle
