#pragma once
// The page that `corpuscle stream --serve` sends.

#include <string>

#include "core/error.hpp"

namespace corpuscle {

/// The page that `make page` has built: embedded in this program, beside it, or installed. Without one, a small page that says how to build
/// it.
Result<std::string> load_live_page();

}  // namespace corpuscle
