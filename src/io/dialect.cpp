#include "io/dialect.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "signal/text.hpp"

namespace corpuscle {
namespace {

std::string_view unquoted(std::string_view s) {
    s = trimmed(s);
    return s.size() >= 2 && s.front() == '"' && s.back() == '"' ? s.substr(1, s.size() - 2) : s;
}

/// Where the field that begins at `at` ends; a separator within quotes does not end it.
std::size_t end_of_field(std::string_view line, std::size_t at, char separator) {
    const auto quote = line.find_first_not_of(" \t", at);
    if (quote != std::string_view::npos && line[quote] == '"')
        if (const auto close = line.find('"', quote + 1); close != std::string_view::npos) return line.find(separator, close);
    return line.find(separator, at);
}

constexpr int exact_powers = 22;  // 10^22 is the last that a double holds exactly
constexpr auto powers_of_ten = [] {
    struct {
        double of[exact_powers + 1];
    } table{};
    table.of[0] = 1;
    for (int k = 1; k <= exact_powers; ++k) table.of[k] = table.of[k - 1] * 10;
    return table;
}();

}  // namespace

Dialect Dialect::of(std::string_view line) {
    for (const char c : {'\t', ';'})
        if (line.find(c) != std::string_view::npos) return {c, true};
    return line.find(',') != std::string_view::npos ? Dialect{',', false} : Dialect{' ', true};
}

void Dialect::split(std::string_view line, Fields& out) const {
    out.clear();
    if (separator == ' ') {
        for (std::size_t at = line.find_first_not_of(" \t"); at != std::string_view::npos;) {
            const auto end = line.find_first_of(" \t", at);
            out.push_back(unquoted(line.substr(at, end - at)));
            at = line.find_first_not_of(" \t", end);
        }
        return;
    }
    for (std::size_t at = 0;;) {
        const auto end = end_of_field(line, at, separator);
        out.push_back(unquoted(line.substr(at, end - at)));
        if (end == std::string_view::npos) return;
        at = end + 1;
    }
}

bool Dialect::number(std::string_view field, double& value, bool any) const {
    if (field.starts_with('+')) field.remove_prefix(1);
    char plain[64];
    if (decimal_comma && field.size() < sizeof plain && field.find(',') != std::string_view::npos) {
        std::replace_copy(field.begin(), field.end(), plain, ',', '.');
        field = std::string_view(plain, field.size());
    }
    const auto [end, status] = std::from_chars(field.data(), field.data() + field.size(), value);
    return status == std::errc{} && end == field.data() + field.size() && (any || std::isfinite(value));
}

bool Dialect::plain_number(const char*& p, const char* end, double& value) const {
    while (p < end && (*p == ' ' || (separator == ' ' && *p == '\t'))) ++p;
    const bool minus = p < end && *p == '-';
    p += minus;
    const char* const first = p;
    std::uint64_t digits = 0;
    const auto take = [&] {
        const char* const from = p;
        while (p < end && static_cast<unsigned char>(*p - '0') < 10) digits = digits * 10 + static_cast<unsigned char>(*p++ - '0');
        return static_cast<int>(p - from);
    };
    const int whole = take();
    int decimals = 0;
    if (p < end && (*p == '.' || (decimal_comma && *p == ','))) ++p, decimals = take();
    // Up to 15 digits are exact in a double, and so is one division by an exact power of ten: the nearest double, as from_chars gives it.
    if (whole + decimals == 0 || p - first > 16 || (p < end && *p != separator && !(separator == ' ' && *p == '\t'))) return false;
    const double size = static_cast<double>(digits) / powers_of_ten.of[decimals];
    value = minus ? -size : size;
    return true;
}

}  // namespace corpuscle
