#include "core/text/csv_field.hpp"

#include "core/text/ascii_text.hpp"
#include "core/text/utf8.hpp"

namespace corpuscle {

std::string quote_csv_field(std::string_view text) {
    const auto name = to_utf8(text);
    if (name.find_first_of(",;\t\"\r\n") == name.npos && trimmed(name).size() == name.size() && !name.starts_with('#') &&
        !name.starts_with('%'))
        return name;
    std::string quoted = "\"";
    for (const char c : name) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

}  // namespace corpuscle
