// Which channel of a recording or frame is which taxel.

#include <fmt/format.h>
#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "core/parameter.hpp"
#include "io/table/heading.hpp"
#include "skin/taxel/taxel_layout.hpp"

namespace corpuscle {
namespace {

/// The error for different numbers of channels and taxels.
Error wrong_channel_count(const TaxelLayout& layout, std::span<const std::string> channels, const std::string& source) {
    const auto taxels = layout.taxels.size();
    const auto counts = fmt::format("{} has {} channel{}, but {} has {} taxels", source, channels.size(), channels.size() == 1 ? "" : "s",
                                    layout.file, taxels);
    if (channels.size() > taxels)
        return bad_input(
            fmt::format("{}: channel '{}' has no row; add it (with dead = 1 if it is not used), or select {} channels by --channel", counts,
                        channels[taxels], taxels));
    const auto& first = layout.taxels[channels.size()];
    return bad_input(fmt::format("{}: taxel '{}' has no channel; remove its row", counts, first.name), first.location);
}

using TaxelIndex = std::unordered_map<std::string_view, std::uint32_t>;

/// The taxel whose name a channel has, with or without a unit.
std::optional<std::uint32_t> taxel_named(const TaxelIndex& index, const std::string& channel) {
    if (const auto at = index.find(channel); at != index.end()) return at->second;
    const auto heading = parse_heading(channel);
    const auto at = index.find(heading.name);
    return at == index.end() ? std::nullopt : std::optional(at->second);
}

Error no_such_taxel(const TaxelLayout& layout, const std::string& channel, const std::string& source) {
    std::vector<std::string_view> names;
    for (const auto& t : layout.taxels) names.push_back(t.name);
    return bad_input(
        fmt::format("channel '{}' of {} has no row in {}{}; add a row (with dead = 1 if it is not used), or select channels by "
                    "--channel",
                    channel.substr(0, 64), source, layout.file, did_you_mean(parse_heading(channel).name, names)));
}

/// The taxels by the names of the channels, of which at least one is a taxel's.
Result<std::vector<std::uint32_t>> match_by_name(const TaxelLayout& layout, const TaxelIndex& index, std::span<const std::string> channels,
                                                 const std::string& source) {
    std::vector<std::uint32_t> out;
    std::vector<char> taken(layout.taxels.size());
    for (const auto& channel : channels) {
        const auto taxel = taxel_named(index, channel);
        if (!taxel) return no_such_taxel(layout, channel, source);
        if (std::exchange(taken[*taxel], 1))
            return bad_input(fmt::format("two channels of {} have the name of taxel '{}'", source, layout.taxels[*taxel].name));
        out.push_back(*taxel);
    }
    for (std::size_t k = 0; k < taken.size(); ++k)
        if (!taken[k])
            return bad_input(
                fmt::format("taxel '{}' is not a channel of {}; remove its row, or correct its name", layout.taxels[k].name, source),
                layout.taxels[k].location);
    return out;
}

}  // namespace

Result<std::vector<std::uint32_t>> match_taxels(const TaxelLayout& layout, std::span<const std::string> channels,
                                                const std::string& source) {
    TaxelIndex index;
    for (std::uint32_t k = 0; k < layout.taxels.size(); ++k) index.emplace(layout.taxels[k].name, k);
    const auto is_taxel = [&](const std::string& channel) { return taxel_named(index, channel).has_value(); };
    if (!layout.has_channel_numbers() && std::any_of(channels.begin(), channels.end(), is_taxel))
        return match_by_name(layout, index, channels, source);
    if (channels.size() != layout.taxels.size()) return wrong_channel_count(layout, channels, source);
    std::vector<std::uint32_t> in_order(channels.size());
    std::iota(in_order.begin(), in_order.end(), 0U);
    return in_order;
}

Result<std::vector<std::uint32_t>> match_frame_columns(const TaxelLayout& layout, std::span<const std::string> columns,
                                                       const std::string& source) {
    if (!layout.has_axes) return match_taxels(layout, columns, source);
    std::vector<std::string> sensors;
    std::vector<std::uint32_t> axes;  // of the columns: 0 is x, 1 is y, 2 is z
    for (const auto& column : columns) {
        const auto name = parse_axis_name(parse_heading(column).name);
        if (!name || name->axis > ForceAxis::z) continue;
        sensors.push_back(name->sensor), axes.push_back(static_cast<std::uint32_t>(name->axis));
    }
    std::vector<std::uint32_t> out(columns.size());
    std::iota(out.begin(), out.end(), 0U);
    if (sensors.empty()) return out;  // no names of axes: the order of the taxels
    if (sensors.size() != columns.size())
        return bad_input(
            fmt::format("{} has columns that are not an axis of a taxel; name them t1.Fx, t1.Fy and t1.Fz for each taxel t1", source));
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        std::vector<std::string> along;  // the sensors with a column for this axis
        std::vector<std::size_t> at;
        for (std::size_t k = 0; k < columns.size(); ++k)
            if (axes[k] == axis) along.push_back(sensors[k]), at.push_back(k);
        const auto taxels = TRY(match_taxels(layout, along, source));
        for (std::size_t k = 0; k < at.size(); ++k) out[at[k]] = 3 * taxels[k] + axis;
    }
    return out;
}

}  // namespace corpuscle
