#include "skin/plan/population_values.hpp"

#include <fmt/format.h>

#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle::skins {
namespace {

constexpr double max_coordinate = 10;  // m

}  // namespace

Result<PopulationValues> PopulationValues::of(const ConfigNode& top) {
    PopulationValues out;
    const auto* text = top.get("unit");
    if (!text) return out;
    const auto unit = parse_unit(text->text);
    if (!unit || !unit->has_same_dimension(*parse_unit("m")))
        return text->error_here(fmt::format("unit = '{}' is not a unit of length; write unit = \"mm\"", text->text));
    out.metres_ = unit->factor;
    return out;
}

Result<double> PopulationValues::number(const LocatedText& item, std::string_view name, std::string_view unit, double low,
                                        double high) const {
    const bool without_unit = parse_bare_number<double>(trimmed(item.text)).has_value(), is_length = unit == "m";
    if (without_unit && !unit.empty() && unit != "deg" && (!is_length || !metres_))
        return item.error_here(fmt::format("{} = {}: the unit is missing; write {} = \"{} {}\"{}", name, item.text, name,
                                           trimmed(item.text),
                                           is_length        ? "mm"
                                           : unit == "1/m2" ? "/cm2"
                                                            : unit,
                                           is_length ? ", or unit = \"mm\" at the top for all lengths" : ""));
    const double value = TRY(item.located(parse_quantity(item.text, unit), std::string(name) + ": "));
    const double si = without_unit && is_length ? value * *metres_ : value;
    if (!(si >= low && si <= high))
        return item.error_here(fmt::format("{} = {} is outside [{}, {}]", name, format_quantity(si, unit), format_quantity(low, unit),
                                           format_quantity(high, unit)));
    return si;
}

Result<double> PopulationValues::number_of(const ConfigNode& table, std::string_view name, std::string_view unit, double low,
                                           double high) const {
    const auto* item = table.get(name);
    return item ? number(*item, name, unit, low, high) : Result<double>(0);
}

Result<std::uint64_t> PopulationValues::integer(const ConfigNode& table, std::string_view name, std::uint64_t low, std::uint64_t high,
                                                std::uint64_t fallback) const {
    const auto* item = table.get(name);
    if (!item) return fallback;
    const auto value = parse_bare_number<std::uint64_t>(trimmed(item->text));
    if (!value || *value < low || *value > high)
        return item->error_here(fmt::format("{} = {}: must be an integer from {} to {}", name, trimmed(item->text), low, high));
    return *value;
}

Result<Position> PopulationValues::position(const LocatedText& x, const LocatedText& y, std::string_view name) const {
    Position out;
    out.x = TRY(number(x, name, "m", -max_coordinate, max_coordinate));
    out.y = TRY(number(y, name, "m", -max_coordinate, max_coordinate));
    return out;
}

Result<Position> PopulationValues::position(const ConfigNode& pair, std::string_view name) const {
    if (!pair.is_list() || pair.elements.size() != 2) return pair.error_here(fmt::format("{}: a position needs two numbers, [x, y]", name));
    TRY(check_list(pair, name));
    return position(pair.elements[0], pair.elements[1], name);
}

Result<LocatedText> required_text(const ConfigNode& table, std::string_view name, std::string_view where, std::string_view example) {
    if (const auto* node = table.get(name)) return LocatedText(*node);
    return table.error_here(fmt::format("{}: {} is missing: {} = {}", where, name, name, example));
}

Result<std::vector<SourceNote>> read_sources(const ConfigNode& table, std::span<const ConfigKey> known) {
    if (const auto* source = table.get("source")) TRY(check_keys(*source, known, "source: "));
    std::vector<SourceNote> out;
    for (const auto& s : table.settings("source")) out.push_back({s.name, s.value.text});
    return out;
}

}  // namespace corpuscle::skins
