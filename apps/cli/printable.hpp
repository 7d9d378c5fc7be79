#pragma once
// Text on its way to a terminal. Names come from files that anybody may have made: a control character in one could move the cursor, set
// the window's title or make up a message. None is printed as it is.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace corpuscle {

/// As it is, but that control characters, line breaks, marks that turn the direction of writing, and bytes that are no UTF-8 are written
/// as \x1b, \n, \u202e, \xff.
std::string printable(std::string_view);

/// The same of text of our own of several lines: these are kept.
std::string printable_lines(std::string_view);

/// A document; what no terminal should see is escaped as JSON has it, so that its meaning stays.
std::string json_text(const nlohmann::ordered_json&);

}  // namespace corpuscle
