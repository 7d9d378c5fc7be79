#pragma once
// Files embedded in the program when it was built: netlists, process cards, populations, and the parts of report pages.

#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// The text of the embedded file with this path in the source tree: "circuits/bias.cir". An unknown path is an error.
Result<std::string> embedded_text(const std::string& path);

/// The text of the embedded file with this name, in any folder: "page.js"; "" if there is none.
std::string_view embedded_text_of(std::string_view name);

/// The path of the embedded process card for a file at this path that does not exist: the path is that of the card, or ends with it after a
/// folder. "" if there is none. So a netlist in any folder can name 'process/tsmc180.lib'.
std::string embedded_card_of(std::string_view path);

/// The paths of all embedded files, such as "process/tsmc180.lib".
std::vector<std::string_view> embedded_files();

}  // namespace corpuscle
