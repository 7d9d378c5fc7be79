#include "core/text/printable.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "core/text/utf8.hpp"

namespace corpuscle {
namespace {

/// Removes the first character of a text that is not empty, and returns its bytes; `code` is its code point, or none if they are not UTF-8.
std::string_view take_character(std::string_view& text, std::optional<char32_t>& code) {
    const auto before = text;
    code = take_code_point(text);
    return before.substr(0, before.size() - text.size());
}

/// C0, DEL, C1, bidirectional marks, line and paragraph separators, and the byte order mark.
bool is_control(char32_t c) {
    return c < 0x20 || (c >= 0x7f && c < 0xa0) || c == 0x61c || c == 0x200e || c == 0x200f || (c >= 0x2028 && c <= 0x202e) ||
           (c >= 0x2066 && c <= 0x2069) || c == 0xfeff;
}

std::string escaped(char32_t c) {
    if (c == '\n') return "\\n";
    if (c == '\t') return "\\t";
    if (c == '\r') return "\\r";
    const auto number = static_cast<std::uint32_t>(c);
    return c < 0x80 ? fmt::format("\\x{:02x}", number) : fmt::format("\\u{:04x}", number);
}

/// Escapes all control characters and invalid bytes, except the ASCII characters in `kept`.
std::string escape_except(std::string_view text, std::string_view kept) {
    std::string out;
    out.reserve(text.size());
    for (std::optional<char32_t> code; !text.empty();) {
        const auto bytes = take_character(text, code);
        if (!code)
            for (const char byte : bytes) out += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
        else
            out += is_control(*code) && kept.find(bytes) == kept.npos ? escaped(*code) : bytes;
    }
    return out;
}

}  // namespace

std::string printable(std::string_view text) { return escape_except(text, ""); }
std::string printable_lines(std::string_view text) { return escape_except(text, "\n"); }

std::size_t columns_of(std::string_view text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::string json_text(const nlohmann::ordered_json& document) {
    const auto text = document.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);  // names may contain any bytes
    std::string out;
    std::optional<char32_t> code;
    for (std::string_view left = text; !left.empty();) {
        // In ASCII only DEL is left to escape: the writer has escaped C0 and replaced invalid bytes, and line breaks format the document.
        const auto plain = std::find_if(left.begin(), left.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x7f; });
        out.append(left.begin(), plain);
        left.remove_prefix(static_cast<std::size_t>(plain - left.begin()));
        if (left.empty()) break;
        const auto bytes = take_character(left, code);
        if (is_control(*code))
            out += fmt::format("\\u{:04x}", static_cast<std::uint32_t>(*code));
        else
            out += bytes;
    }
    return out;
}

}  // namespace corpuscle
