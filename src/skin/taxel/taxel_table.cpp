#include "skin/taxel/taxel_table.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/parameter.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

constexpr std::array<std::string_view, taxel_column_count> taxel_columns = {"name",   "channel", "x",      "y",       "area",    "width",
                                                                            "height", "patch",   "region", "patch_x", "patch_y", "rotation",
                                                                            "dead",   "x_axis",  "y_axis", "z_axis"};

std::string_view taxel_column_name(TaxelColumn c) { return taxel_columns[static_cast<std::size_t>(c)]; }

bool is_ignored_column(std::string_view heading) { return heading == "z" || heading == "note"; }

/// The unit of a column: "m", "m2", "deg", or "" for a text.
std::string_view dimension_of(TaxelColumn c) {
    using enum TaxelColumn;
    if (c == area) return "m2";
    if (c == rotation) return "deg";
    const TaxelColumn lengths[] = {x, y, width, height, patch_x, patch_y};
    return std::find(std::begin(lengths), std::end(lengths), c) != std::end(lengths) ? "m" : "";
}

/// The names of the columns with usual units, as a file has them: "width_mm".
std::vector<std::string_view> full_column_names() {
    static const auto names = [] {
        std::vector<std::string> all;
        for (std::size_t c = 0; c < taxel_column_count; ++c) {
            const auto dimension = dimension_of(static_cast<TaxelColumn>(c));
            all.push_back(std::string(taxel_columns[c]) + (dimension.empty() ? "" : dimension == "deg" ? "_deg" : "_m") +
                          (dimension.starts_with('m') ? std::string(dimension) : ""));
        }
        return all;
    }();
    return {names.begin(), names.end()};
}

}  // namespace

/// The factor from the unit in the heading to m, m2 or degrees.
Result<double> TaxelTable::factor_of(TaxelColumn c, std::size_t field) const {
    const auto dimension = dimension_of(c);
    const auto& unit = table_.headings()[field].unit;
    if (dimension.empty()) return 1;
    if (dimension == "deg") {
        const auto angle = unit.empty() ? Result<Unit>(Unit{}) : parse_unit(unit);
        if (angle && angle->has_same_dimension(*parse_unit("deg"))) return angle->factor;
        return table_.error_at("the rotation needs a unit of angle; write rotation_deg", field);
    }
    const auto parsed = unit.empty() ? Result<Unit>(Unit{}) : parse_unit(unit);
    if (parsed && parsed->has_same_dimension(*parse_unit(dimension))) return parsed->factor;
    return table_.error_at(fmt::format("column '{}' needs a unit of {}; write {}_m{}", table_.fields()[field].substr(0, 40),
                                       dimension == "m" ? "length" : "area", taxel_column_name(c), dimension),
                           field);
}

Result<void> TaxelTable::read_heading(std::size_t field) {
    const auto heading = lower(table_.headings()[field].name);
    if (is_ignored_column(heading)) return {};
    const auto found = std::find(taxel_columns.begin(), taxel_columns.end(), heading);
    if (found == taxel_columns.end())
        return table_.error_at(fmt::format("unknown column '{}'{}; the columns are {}; z and note are ignored",
                                           table_.fields()[field].substr(0, 40), did_you_mean(lower(table_.fields()[field]), full_column_names()),
                                           joined(full_column_names())),
                               field);
    const auto c = static_cast<std::size_t>(found - taxel_columns.begin());
    if (columns_[c]) return table_.error_at(fmt::format("column '{}' occurs twice", *found), field);
    columns_[c] = field;
    factors_[c] = TRY(factor_of(static_cast<TaxelColumn>(c), field));
    return {};
}

/// Checks which columns occur together.
Result<void> TaxelTable::check_columns() const {
    if (!(has(name) || has(channel)) || !has(x) || !has(y))
        return error_at(fmt::format("a layout of taxels needs the columns name (or channel), x and y (x_mm, y_mm); this one has {}",
                                    joined(table_.fields())));
    if (has(width) != has(height)) {
        const auto given = has(width) ? width : height, missing = has(width) ? height : width;
        return error_at(fmt::format("a rectangle needs width and height; add a column {}_mm", taxel_column_name(missing)), given);
    }
    if (has(width) && has(area)) return error_at("use area (a disc), or width and height (a rectangle), not both", area);
    return {};
}

Result<void> TaxelTable::read_header() {
    if (!TRY(table_.read_header())) return bad_input("no taxels in this file", {path()});
    for (std::size_t field = 0; field < table_.headings().size(); ++field) TRY(read_heading(field));
    return check_columns();
}

Result<bool> TaxelTable::next() {
    if (!TRY(table_.next())) return false;
    const auto fields = table_.fields().size(), expected = table_.headings().size();
    if (fields != expected) return error_at(fmt::format("{} columns instead of {}", fields, expected));
    return true;
}

std::string_view TaxelTable::text(TaxelColumn c) const { return has(c) ? trimmed(table_.fields()[index(c)]) : std::string_view(); }

Result<std::optional<double>> TaxelTable::number(TaxelColumn c, double limit) const {
    if (text(c).empty()) return std::optional<double>();
    double value;
    if (!table_.number(index(c), value) || !std::isfinite(value))
        return error_at(fmt::format("{}: '{}' is not a number", taxel_column_name(c), text(c).substr(0, 40)), c);
    const double factor = factors_[static_cast<std::size_t>(c)];
    if (!(std::abs(value * factor) <= limit))
        return error_at(fmt::format("{} = {:g} is out of range: at most {:g} {}", taxel_column_name(c), value, limit / factor,
                                    table_.headings()[index(c)].unit),
                        c);
    return std::optional(value * factor);
}

Result<double> TaxelTable::required(TaxelColumn c, double limit) const {
    const auto value = TRY(number(c, limit));
    if (value) return *value;
    return error_at(fmt::format("{} is empty; every taxel needs it", taxel_column_name(c)), c);
}

}  // namespace corpuscle
