#include "skin/said_numbers.hpp"

#include <fmt/format.h>
#include <charconv>

#include "signal/quantity.hpp"
#include "signal/text.hpp"

namespace corpuscle::skins {
namespace {

/// Whether a text is a number without a unit.
bool is_bare(std::string_view text) {
    text = trimmed(text);
    double value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    return status == std::errc{} && end == text.data() + text.size();
}

}  // namespace

Result<double> SaidNumbers::number(const Said& said, std::string_view name, std::string_view unit, double low, double high) const {
    const bool bare = is_bare(said.text), length = unit == "m";
    if (bare && !unit.empty() && (!length || !metres_))
        return said.wrong(fmt::format("{} = {}: of which unit? Write {} = \"{} {}\"{}", name, said.text, name, trimmed(said.text),
                                      length           ? "mm"
                                      : unit == "1/m2" ? "/cm2"
                                                       : unit,
                                      length ? ", or unit = \"mm\" at the top for all lengths" : ""));
    const auto value = parse_quantity(said.text, unit);
    if (!value) return said.wrong(fmt::format("{}: {}", name, value.error().sentence));
    const double si = bare && length ? *value * *metres_ : *value;
    if (!(si >= low && si <= high))
        return said.wrong(fmt::format("{} = {} is outside [{}, {}]", name, format_quantity(si, unit), format_quantity(low, unit),
                                      format_quantity(high, unit)));
    return si;
}

Result<double> SaidNumbers::number(const MaybeSaid& said, std::string_view name, std::string_view unit, double low, double high,
                                   double otherwise) const {
    return said ? number(*said, name, unit, low, high) : Result<double>(otherwise);
}

Result<std::uint64_t> SaidNumbers::whole(const MaybeSaid& said, std::string_view name, std::uint64_t low, std::uint64_t high,
                                         std::uint64_t otherwise) const {
    if (!said) return otherwise;
    const auto text = trimmed(said->text);
    std::uint64_t value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc{} || end != text.data() + text.size() || value < low || value > high)
        return said->wrong(fmt::format("{} = {}: a whole number from {} to {} is wanted", name, text, low, high));
    return value;
}

}  // namespace corpuscle::skins
