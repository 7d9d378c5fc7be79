#include "skin/plan/sites.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace corpuscle {

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

}  // namespace corpuscle
