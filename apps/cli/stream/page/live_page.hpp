#pragma once
// The page that `corpuscle stream --serve` sends.

#include <string>
#include <string_view>

#include "core/error.hpp"

namespace corpuscle {

/// The page that `make page` has built: embedded in this program, in the folder of builds, or installed. `purpose`, "corpuscle-engine" or
/// "corpuscle-stream", is the name of a meta element that tells the page which WebSocket it has, and how many bytes a message to it may
/// have. Without a page that knows this name, a small one that says how to build it.
Result<std::string> load_live_page(std::string_view purpose, std::size_t max_request);

}  // namespace corpuscle
