#include "io/recording/field_advice.hpp"

#include "core/text/ascii_text.hpp"
#include "io/table/heading.hpp"

namespace corpuscle {
namespace {

bool is_decimal_digit(char c) { return c >= '0' && c <= '9'; }
bool is_ascii_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// The length of the number at the beginning of the text, or 0.
std::size_t length_of_number(std::string_view text) {
    double value;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    return status == std::errc{} && end > text.data() && is_decimal_digit(end[-1]) ? static_cast<std::size_t>(end - text.data()) : 0;
}

/// True for a number with thousands separators: one to three digits, then groups of `separator` and three digits, then optional decimals
/// after `point`. "1.016,21" has the separator . and the point , (comma).
bool has_groups(std::string_view text, char separator, char point) {
    if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
    const auto point_at = text.find(point);
    const auto integer_part = text.substr(0, point_at);
    if (point_at != text.npos && !std::all_of(text.begin() + static_cast<std::ptrdiff_t>(point_at) + 1, text.end(), is_decimal_digit))
        return false;
    std::size_t groups = 0, digits = 0;
    for (const char c : integer_part) {
        if (is_decimal_digit(c)) {
            ++digits;
        } else {
            if (c != separator || digits == 0 || digits > 3 || (groups > 0 && digits != 3)) return false;
            ++groups, digits = 0;
        }
    }
    return groups > 0 && digits == 3;
}

}  // namespace

FieldAdvice advise_on_field(std::string_view field) {
    constexpr std::string_view minus = "\u2212";  // the minus sign of typesetting, which is not the hyphen of ASCII
    if (has_groups(field, '.', ',') || has_groups(field, ',', '.') || has_groups(field, '\'', '.') || has_groups(field, ' ', '.'))
        return {"a thousands separator", "", "save the table without it"};
    if (field.starts_with(minus) && length_of_number(field.substr(minus.size())) > 0)
        return {"a typographic minus sign (U+2212)", "sed 's/\u2212/-/g'"};
    if (field.find('|') != field.npos) return {"'|' as a separator", "sed 's/ *| */;/g'"};
    const auto number = length_of_number(field);  // in bytes; for 0x1F it is 1, the length of the zero
    if (number == 1 && field.size() > 2 && (field[1] == 'x' || field[1] == 'X'))
        return {"hexadecimal digits", "", "save the table with decimal numbers"};
    if (number == 0) {
        const auto colon = field.find_first_of(":=");
        if (colon != field.npos && length_of_number(trimmed(field.substr(colon + 1))) > 0)
            return {"a name before the number", "sed -E 's/[A-Za-z_]+ *[:=] *//g'"};
        return {};
    }
    const auto rest = field.substr(number);
    if (rest.empty()) return {};
    if ((rest[0] == 'D' || rest[0] == 'd') && length_of_number(rest.substr(rest.substr(1).starts_with('+') ? 2 : 1)) > 0)
        return {"a Fortran exponent", "sed -E 's/([0-9.])[dD]([-+0-9])/\\1e\\2/g'"};
    const auto unit = std::string(trimmed(rest));
    if (!is_unit(unit) || !std::all_of(unit.begin(), unit.end(), is_ascii_letter)) return {};
    return {"the unit " + unit + " after the number" + (unit == "N" ? "" : " (use --unit " + unit + " for the new file)"),
            "sed -E 's/([0-9.]) *" + unit + "([^A-Za-z]|$)/\\1\\2/g'"};
}

}  // namespace corpuscle
