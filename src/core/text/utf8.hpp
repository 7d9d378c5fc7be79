#pragma once
// Recognition of, and conversion to, UTF-8.

#include <optional>
#include <string>
#include <string_view>

namespace corpuscle {

/// Removes the first character of a text that is not empty, and returns its code point. nullopt: the first bytes are not a character; as
/// many of them are removed as could begin one.
std::optional<char32_t> take_code_point(std::string_view& text);

/// Appends a code point as UTF-8; U+FFFD if it is a surrogate or above U+10FFFF.
void append_utf8(std::string& out, char32_t code_point);

bool is_utf8(std::string_view);

/// Text as UTF-8. Text that is not valid UTF-8 is converted from Windows-1252, which instruments and spreadsheets write.
std::string to_utf8(std::string_view);

}  // namespace corpuscle
