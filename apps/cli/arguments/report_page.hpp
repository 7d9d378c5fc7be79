#pragma once
// The name of a report page.

#include <string>

#include "core/error.hpp"

namespace corpuscle {

/// Returns an error if a report page is requested by a name that does not end in .html. "": none, or the default name.
Result<void> check_page_name(const std::string& name);

}  // namespace corpuscle
