#include "skin/plan/site_table.hpp"

#include <fmt/format.h>
#include <cmath>
#include <filesystem>
#include <optional>

#include "core/text/quantity.hpp"
#include "io/text/named_columns.hpp"

namespace corpuscle {
namespace {

/// The columns of a table of sites.
struct SiteColumns {
    std::size_t name;
    std::optional<std::size_t> region;
    std::size_t axes[2];  // of x and y
    double metres[2];     // the units of x and y, m
};

Result<SiteColumns> find_columns(const NamedColumns& table) {
    SiteColumns out{};
    const auto name = table.find({"name"});
    bool is_complete = name.has_value();
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const std::string_view word = axis == 0 ? "x" : "y";
        const auto column = table.find({word});
        is_complete = is_complete && column;
        if (!column) continue;
        const auto unit = parse_unit(table.headings()[*column].unit);
        if (table.headings()[*column].unit.empty() || !unit || !unit->has_same_dimension(*parse_unit("m")))
            return table.error_at(fmt::format("column '{0}' needs a unit of length; write {1}_mm or {1}_m", table.fields()[*column], word),
                                  *column);
        out.axes[axis] = *column, out.metres[axis] = unit->factor;
    }
    if (!is_complete)
        return table.error_at(
            fmt::format("a table of sites needs the columns name, x and y (x_mm, y_mm); this one has {}", fmt::join(table.fields(), ", ")));
    out.name = *name, out.region = table.find({"region"});
    return out;
}

/// Adds the site in the current line.
Result<void> add_row(const NamedColumns& table, const SiteColumns& columns, Sites& out) {
    const auto& fields = table.fields();
    if (fields.size() != table.headings().size())
        return table.error_at(fmt::format("{} columns instead of {}", fields.size(), table.headings().size()));
    double position[2];
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const auto column = columns.axes[axis];
        if (!table.number(column, position[axis]))
            return table.error_at(fmt::format("'{}' is not a coordinate", fields[column].substr(0, 40)), column);
        position[axis] *= columns.metres[axis];
        if (!(std::abs(position[axis]) <= 10))
            return table.error_at(fmt::format("{:g} m is too far away: coordinates must be within 10 m", position[axis]), column);
    }
    if (out.size() == max_sites) return table.error_at(fmt::format("more than {} sites", max_sites));
    out.add({position[0], position[1], 0}, std::string(fields[columns.name]),
            std::string(columns.region ? fields[*columns.region] : "skin"));
    return {};
}

}  // namespace

Result<Sites> read_site_table(const std::string& path) {
    std::error_code status;
    if (!std::filesystem::is_regular_file(path, status)) return bad_input("cannot be read: there is no such file", {path});
    NamedColumns table(TRY(LineReader::open(path)));
    if (!TRY(table.read_header())) return bad_input("no sites in this file", {path});
    const auto columns = TRY(find_columns(table));
    Sites out;
    while (TRY(table.next())) TRY(add_row(table, columns, out));
    if (out.positions.empty()) return bad_input("no sites in this file", {path});
    return out;
}

}  // namespace corpuscle
