#include "live/input/frame_header.hpp"

#include <algorithm>

#include "io/table/heading.hpp"
#include "io/text/dialect.hpp"

namespace corpuscle {
namespace {

/// True if the text begins with a number, which a separator may follow: "3", "0,5".
bool begins_with_number(std::string_view text) { return number_in(next_field(text)).has_value(); }

/// True for several words with brackets at the end, if there is not a unit in them: "load cell (serial 4)".
bool is_sentence(std::string_view field) {
    const auto heading = parse_heading(field);
    return heading.name.find(' ') != std::string::npos && !heading.unit.empty() && !is_unit(heading.unit);
}

/// The fields of a line that is split as the readers of recordings do. A line that is to be one field is split by nothing but commas.
Fields split_header(std::string_view line, std::size_t fields) {
    auto dialect = Dialect::detect(line);
    if (fields == 1 && dialect.separator == ' ') dialect.separator = ',';
    Fields out;
    dialect.split(line, out);
    return out;
}

}  // namespace

std::size_t fields_in(std::string_view line) {
    std::size_t fields = 0;
    for (; !line.empty(); ++fields) next_field(line);
    return fields;
}

std::vector<std::string> header_names(std::string_view line, std::size_t fields, bool is_comment) {
    line = trimmed(line);
    if (line.empty()) return {};
    auto names = split_header(line, fields);
    if (names.size() != fields) {  // other separators, such as a comma at the end
        names.clear();
        for (auto rest = line; !rest.empty();) names.push_back(unquoted_field(next_field(rest)));
    }
    const auto is_not_name = [](std::string_view name) { return name.empty() || begins_with_number(name); };
    if (names.size() != fields || std::any_of(names.begin(), names.end(), is_not_name)) return {};
    if ((is_comment || fields == 1) && std::any_of(names.begin(), names.end(), is_sentence)) return {};
    return {names.begin(), names.end()};
}

bool has_decimal_commas(std::string_view line, std::size_t fields) {
    for (const char separator : {'\t', ';', ' '}) {
        Fields found;
        const Dialect dialect{separator, true};
        dialect.split(trimmed(line), found);
        double value;
        if (found.size() == fields && line.find(',') != line.npos &&
            std::all_of(found.begin(), found.end(), [&](auto field) { return dialect.parse_number(field, value); }))
            return true;
    }
    return false;
}

}  // namespace corpuscle
