#include "skin/plan/sites.hpp"

#include <fmt/format.h>
#include <cmath>
#include <filesystem>
#include <unordered_map>
#include <unordered_set>

#include "core/parameter.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"
#include "io/table/heading.hpp"
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
            fmt::format("a table of sites needs the columns name, x and y (x_mm, y_mm); this one has {}", joined(table.fields())));
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

using SiteIndex = std::unordered_map<std::string_view, std::uint32_t>;

SiteIndex index_sites(const Sites& sites) {
    SiteIndex index;
    for (std::size_t s = 0; s < sites.size(); ++s) index.emplace(sites.names[s], static_cast<std::uint32_t>(s));
    return index;
}

/// The message for a name that is not a site.
std::string no_such_site(const Sites& sites, std::string_view name) {
    const std::vector<std::string_view> some(sites.names.begin(),
                                             sites.names.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(sites.size(), 1000)));
    return fmt::format("there is no site '{}'{}; the first are {}; 'corpuscle list POPULATION --sites' prints all", name.substr(0, 64),
                       did_you_mean(name, some), joined(std::span(some).first(std::min<std::size_t>(some.size(), 3))));
}

/// The columns of a layout of frames.
struct LayoutColumns {
    std::size_t channel, name;
};

Result<LayoutColumns> find_layout_columns(const NamedColumns& table) {
    const auto channel = table.find({"channel", "sensor"}), name = table.find({"name"});
    if (channel && name) return LayoutColumns{*channel, *name};
    return table.error_at(
        "a layout of frames needs the columns channel and name: channel is the number of a value in the frame, from 1; name is a site");
}

/// Stores the site of the channel in the current line in `map`, whose elements are the sites of all channels. `taken` has for each site 1
/// if a channel has it.
Result<void> add_channel(const NamedColumns& table, const LayoutColumns& columns, const Sites& sites, const SiteIndex& index,
                         std::vector<std::optional<std::uint32_t>>& map, std::vector<char>& taken) {
    const auto& fields = table.fields();
    if (fields.size() <= std::max(columns.channel, columns.name)) return table.error_at("this row has too few columns");
    const auto number = fields[columns.channel], name = fields[columns.name];
    const auto channel = parse_bare_number<std::size_t>(number).value_or(0);
    if (channel < 1 || channel > sites.size())
        return table.error_at(
            fmt::format("channel '{}': must be a number from 1 to {}, the number of sites", number.substr(0, 64), sites.size()),
            columns.channel);
    const auto entry = index.find(name);
    if (entry == index.end()) return table.error_at(no_such_site(sites, name), columns.name);
    if (map.size() < channel) map.resize(channel);
    if (std::exchange(taken[entry->second], 1)) return table.error_at(fmt::format("site '{}' has two channels", name), columns.name);
    if (map[channel - 1]) return table.error_at(fmt::format("channel {} has two rows", channel), columns.channel);
    map[channel - 1] = entry->second;
    return {};
}

}  // namespace

void Sites::add(const Position& position, std::string name, const std::string& region_name) {
    const auto found = std::find(regions.begin(), regions.end(), region_name);
    region.push_back(static_cast<std::uint32_t>(found - regions.begin()));
    if (found == regions.end()) regions.push_back(region_name);
    positions.push_back(position), names.push_back(std::move(name));
}

Result<Sites> grid_sites(std::size_t rows, std::size_t columns, double pitch) {
    if (rows == 0 || columns == 0 || rows > max_sites || columns > max_sites || rows * columns > max_sites)
        return bad_input(fmt::format("a grid of {} rows and {} columns: it must have 1 to {} sites", rows, columns, max_sites));
    if (!(pitch > 0 && pitch <= 1)) return bad_input(fmt::format("a grid's pitch of {:g} m is outside (0, 1] m", pitch));
    Sites out;
    out.regions = {"grid"};
    out.region.assign(rows * columns, 0);
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t c = 0; c < columns; ++c) {
            out.positions.push_back({static_cast<double>(c) * pitch, static_cast<double>(r) * pitch, 0});
            out.names.push_back(fmt::format("r{}c{}", r + 1, c + 1));
        }
    return out;
}

Result<Sites> channel_sites(std::span<const Channel> channels) {
    if (channels.empty() || channels.size() > max_sites)
        return bad_input(fmt::format("{} channels as sites of a skin: there must be 1 to {}", channels.size(), max_sites));
    Sites out;
    out.regions = {"channels"};
    out.region.assign(channels.size(), 0);
    for (const auto& c : channels) {
        if (!c.position)
            return bad_input(
                fmt::format("channel '{}' has no position on the skin; give a layout file with all positions "
                            "(--layout, columns channel, x_mm, y_mm)",
                            c.name));
        out.positions.push_back(*c.position);
        out.names.push_back(c.name);
    }
    return out;
}

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

Result<std::vector<std::uint32_t>> find_sites(const Sites& sites, std::span<const std::string> names) {
    const auto index = index_sites(sites);
    std::vector<char> taken(sites.size());
    std::vector<std::uint32_t> found;
    for (const auto& name : names) {
        const auto at = index.find(name);
        if (at == index.end()) return bad_input(no_such_site(sites, name));
        if (std::exchange(taken[at->second], 1)) return bad_input(fmt::format("two channels have the name '{}', which is one site", name));
        found.push_back(at->second);
    }
    return found;
}

Result<std::optional<std::vector<std::uint32_t>>> find_sites_if_named(const Sites& sites, std::span<const std::string> names) {
    std::unordered_set<std::string> known;  // in lower case, so that 'R1C1' is recognised as a site
    for (const auto& name : sites.names) known.insert(lower(name));
    const auto is_site = [&](const std::string& name) { return known.contains(lower(name)); };
    std::vector<std::string> without_units;
    for (const auto& name : names) without_units.push_back(is_site(name) ? name : parse_heading(name).name);
    if (std::none_of(without_units.begin(), without_units.end(), is_site)) return std::optional<std::vector<std::uint32_t>>();
    for (const auto& name : without_units) {
        // If a recording has two channels r1c1, its reader names the second "r1c1 (2)".
        const auto first = name.substr(0, name.rfind(" ("));
        if (!is_site(name) && name.ends_with(')') && is_site(first))
            return bad_input(fmt::format("two channels have the name '{}', which is one site", first));
    }
    auto found = find_sites(sites, without_units);
    return found ? std::optional(std::move(*found)) : Result<std::optional<std::vector<std::uint32_t>>>(found.error());
}

Result<std::vector<std::uint32_t>> read_site_map(const std::string& path, const Sites& sites) {
    std::error_code status;
    if (!std::filesystem::is_regular_file(path, status)) return bad_input("cannot be read: there is no such file", {path});
    NamedColumns table(TRY(LineReader::open(path)));
    TRY(table.read_header());
    const auto columns = TRY(find_layout_columns(table));
    const auto index = index_sites(sites);
    std::vector<std::optional<std::uint32_t>> map;
    std::vector<char> taken(sites.size());
    while (TRY(table.next())) TRY(add_channel(table, columns, sites, index, map, taken));
    std::vector<std::uint32_t> out;
    for (const auto& site : map) {
        if (!site) return bad_input(fmt::format("channel {} has no row, although channel {} has one", out.size() + 1, map.size()), {path});
        out.push_back(*site);
    }
    if (out.empty()) return bad_input("no channels in this layout", {path});
    return out;
}

}  // namespace corpuscle
