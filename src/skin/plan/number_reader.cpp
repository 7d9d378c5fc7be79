#include "skin/plan/number_reader.hpp"

#include <fmt/format.h>
#include <charconv>

#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle::skins {
namespace {

/// True if a text is only a number, without a unit.
bool has_no_unit(std::string_view text) {
    text = trimmed(text);
    double value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    return status == std::errc{} && end == text.data() + text.size();
}

}  // namespace

Result<double> NumberReader::number(const LocatedText& item, std::string_view name, std::string_view unit, double low, double high) const {
    const bool without_unit = has_no_unit(item.text), is_length = unit == "m";
    if (without_unit && !unit.empty() && (!is_length || !metres_))
        return item.error_here(fmt::format("{} = {}: the unit is missing; write {} = \"{} {}\"{}", name, item.text, name,
                                           trimmed(item.text),
                                           is_length        ? "mm"
                                           : unit == "1/m2" ? "/cm2"
                                                            : unit,
                                           is_length ? ", or unit = \"mm\" at the top for all lengths" : ""));
    const auto value = parse_quantity(item.text, unit);
    if (!value) return item.error_here(fmt::format("{}: {}", name, value.error().message));
    const double si = without_unit && is_length ? *value * *metres_ : *value;
    if (!(si >= low && si <= high))
        return item.error_here(fmt::format("{} = {} is outside [{}, {}]", name, format_quantity(si, unit), format_quantity(low, unit),
                                           format_quantity(high, unit)));
    return si;
}

Result<double> NumberReader::number(const OptionalLocatedText& item, std::string_view name, std::string_view unit, double low, double high,
                                    double fallback) const {
    return item ? number(*item, name, unit, low, high) : Result<double>(fallback);
}

Result<std::uint64_t> NumberReader::integer(const OptionalLocatedText& item, std::string_view name, std::uint64_t low, std::uint64_t high,
                                            std::uint64_t fallback) const {
    if (!item) return fallback;
    const auto text = trimmed(item->text);
    std::uint64_t value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc{} || end != text.data() + text.size() || value < low || value > high)
        return item->error_here(fmt::format("{} = {}: must be an integer from {} to {}", name, text, low, high));
    return value;
}

}  // namespace corpuscle::skins
