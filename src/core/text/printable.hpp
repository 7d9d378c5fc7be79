#pragma once
// Escapes text for a terminal, and measures it.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace corpuscle {

// Names come from untrusted files: a control character in one could move the cursor, set the window title or forge a message. Control
// characters are therefore never printed raw.

/// Escapes control characters, line breaks, bidirectional marks and bytes that are not UTF-8: \x1b, \n, \u202e, \xff.
std::string printable(std::string_view);

/// The same, but keeps line breaks; for text of several lines that the program composed.
std::string printable_lines(std::string_view);

/// The width of a UTF-8 text in columns of a terminal, one per character.
std::size_t columns_of(std::string_view);

/// The text of a JSON document, in which the same characters are escaped as JSON does it (\u202e). The content is unchanged, except that
/// bytes that are not UTF-8 are replaced.
std::string json_text(const nlohmann::ordered_json&);

}  // namespace corpuscle
