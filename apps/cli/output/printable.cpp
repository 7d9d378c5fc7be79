#include "cli/output/printable.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <nlohmann/json.hpp>

#include "io/text/utf8.hpp"

namespace corpuscle {
namespace {

/// A decoded UTF-8 character. If it is not valid, `bytes` is 1 and `code` is meaningless.
struct Character {
    std::uint32_t code = 0;
    std::size_t bytes = 1;
    bool is_valid = false;
};

/// Decodes the first character of a non-empty text.
Character first_character(std::string_view text) {
    const auto byte = [&](std::size_t k) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[k])); };
    if (byte(0) < 0x80) return {byte(0), 1, true};
    const std::size_t bytes = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
    if (!is_utf8(text.substr(0, bytes))) return {};
    auto code = byte(0) & (0xffU >> (bytes + 1));
    for (std::size_t k = 1; k < bytes; ++k) code = code << 6 | (byte(k) & 0x3fU);
    return {code, bytes, true};
}

/// C0, DEL, C1, bidirectional marks, line and paragraph separators, and the byte order mark.
bool is_control(std::uint32_t c) {
    return c < 0x20 || (c >= 0x7f && c < 0xa0) || c == 0x61c || c == 0x200e || c == 0x200f || (c >= 0x2028 && c <= 0x202e) ||
           (c >= 0x2066 && c <= 0x2069) || c == 0xfeff;
}

std::string escaped(std::uint32_t c) {
    if (c == '\n') return "\\n";
    if (c == '\t') return "\\t";
    if (c == '\r') return "\\r";
    return c < 0x80 ? fmt::format("\\x{:02x}", c) : fmt::format("\\u{:04x}", c);
}

/// Escapes all control characters and invalid bytes, except the ASCII characters in `kept`.
std::string escape_except(std::string_view text, std::string_view kept) {
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const auto c = first_character(text);
        if (!c.is_valid)
            fmt::format_to(std::back_inserter(out), "\\x{:02x}", static_cast<unsigned char>(text[0]));
        else if (is_control(c.code) && (c.bytes > 1 || kept.find(text[0]) == kept.npos))
            out += escaped(c.code);
        else
            out += text.substr(0, c.bytes);
        text.remove_prefix(c.bytes);
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
    for (std::string_view left = text; !left.empty();) {
        const auto c = first_character(left);
        // In one byte only DEL is left to escape: the writer has escaped C0 and replaced invalid bytes, and line breaks format the
        // document.
        const bool is_kept = c.bytes == 1 ? left[0] != '\x7f' : !is_control(c.code);
        is_kept ? out += left.substr(0, c.bytes) : out += fmt::format("\\u{:04x}", c.code);
        left.remove_prefix(c.bytes);
    }
    return out;
}

}  // namespace corpuscle
