#include "io/text/dialect.hpp"

#include <cmath>

#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

/// The position of the separator after the field that begins at `at`; npos for the last field. A separator within quotes does not end it.
std::size_t end_of_field(std::string_view line, std::size_t at, char separator) {
    const auto quote = line.find_first_not_of(" \t", at);
    if (quote != std::string_view::npos && line[quote] == '"') {
        auto close = line.find('"', quote + 1);
        // A doubled quote is part of the field.
        while (close != std::string_view::npos && line.substr(close + 1).starts_with('"')) close = line.find('"', close + 2);
        if (close != std::string_view::npos) return line.find(separator, close);
    }
    return line.find(separator, at);
}

}  // namespace

std::string_view unquoted_field(std::string_view s) {
    s = trimmed(s);
    return s.size() >= 2 && s.front() == '"' && s.back() == '"' ? s.substr(1, s.size() - 2) : s;
}

Dialect Dialect::detect(std::string_view line) {
    for (const char c : {'\t', ';'})
        if (line.find(c) != std::string_view::npos) return {c, true};
    return line.find(',') != std::string_view::npos ? Dialect{',', false} : Dialect{' ', true};
}

void Dialect::split(std::string_view line, Fields& out) const {
    out.clear();
    if (separator == ' ') {
        for (std::size_t at = line.find_first_not_of(" \t"); at != std::string_view::npos;) {
            const auto end = line.find_first_of(" \t", at);
            out.push_back(unquoted_field(line.substr(at, end - at)));
            at = line.find_first_not_of(" \t", end);
        }
        return;
    }
    for (std::size_t at = 0;;) {
        const auto end = end_of_field(line, at, separator);
        out.push_back(unquoted_field(line.substr(at, end - at)));
        if (end == std::string_view::npos) return;
        at = end + 1;
    }
}

bool Dialect::parse_number(std::string_view field, double& value, bool any) const {
    if (field.starts_with('+')) field.remove_prefix(1);
    char with_point[64];
    if (decimal_comma && field.size() < sizeof with_point && field.find(',') != std::string_view::npos) {
        std::replace_copy(field.begin(), field.end(), with_point, ',', '.');
        field = std::string_view(with_point, field.size());
    }
    const auto [end, status] = std::from_chars(field.data(), field.data() + field.size(), value);
    return status == std::errc{} && end == field.data() + field.size() && (any || std::isfinite(value));
}

/// Like parse_plain_number() after the sign, but reads digit by digit, so that it can read up to fifteen digits.
bool Dialect::parse_longer_number(const char*& p, const char* end, double& value) const {
    std::uint64_t digits = 0;
    const auto read_digits = [&] {
        const char* const from = p;
        while (p < end && static_cast<unsigned char>(*p - '0') < 10) digits = digits * 10 + static_cast<unsigned char>(*p++ - '0');
        return p - from;
    };
    const auto integer_digits = read_digits();
    std::ptrdiff_t fraction_digits = 0;
    if (p < end && (*p == '.' || (decimal_comma && *p == ','))) ++p, fraction_digits = read_digits();
    if (integer_digits + fraction_digits == 0 || integer_digits + fraction_digits > 15 || !ends_at(p, end)) return false;
    value = static_cast<double>(digits) / powers_of_ten[fraction_digits];
    return true;
}

}  // namespace corpuscle
