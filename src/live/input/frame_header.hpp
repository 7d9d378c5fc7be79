#pragma once
// The fields of a line of CSV frames: numbers, or the names of a header.

#include "core/text/ascii_text.hpp"

namespace corpuscle {

/// Removes the next field from the line. Blanks around a field are ignored; several blanks are one separator.
inline std::string_view next_field(std::string_view& line) {
    const auto is_separator = [](char c) { return c == ',' || c == ';' || c == '\t' || c == ' '; };
    const auto end = std::min(static_cast<std::size_t>(std::find_if(line.begin(), line.end(), is_separator) - line.begin()), line.size());
    const auto field = line.substr(0, end);
    auto rest = trimmed(line.substr(end));
    if (!rest.empty() && (rest.front() == ',' || rest.front() == ';')) rest = trimmed(rest.substr(1));
    line = rest;
    return field;
}

/// Number of fields in a line.
std::size_t fields_in(std::string_view line);

/// The number in a field, which may be NaN; no value if it is not a number.
inline std::optional<double> number_in(std::string_view field) {
    double x = 0;
    if (field.starts_with('+')) field.remove_prefix(1);  // from_chars() does not accept it
    const auto [end, status] = std::from_chars(field.data(), field.data() + field.size(), x);
    return status == std::errc{} && end == field.data() + field.size() ? std::optional(x) : std::nullopt;
}

/// The names in a line that has this number of fields, none of which is a number or "nan"; empty for other lines. A name may contain
/// blanks, as in "fz [mN]", if blanks are not the separator. A comment, and a line of one field, is not a header if a field is several
/// words with brackets at the end that hold no unit.
std::vector<std::string> header_names(std::string_view line, std::size_t fields, bool is_comment = false);

/// True if the line has this number of fields and all are numbers, provided that its commas are decimal commas.
bool has_decimal_commas(std::string_view line, std::size_t fields);

}  // namespace corpuscle
