#include "skin/shear_force.hpp"

#include <numbers>

#include "core/number/elementary.hpp"

namespace corpuscle {

std::array<double, 2> shear_gains(const DirectionTuning& tuning, const SkinAfferent& u) {
    const double turns = u.direction / (2 * std::numbers::pi);
    return {tuning.gain * num::cos_turns(turns), tuning.gain * num::sin_turns(turns)};
}

ShearForce::ShearForce(const DirectionTuning& tuning, std::span<const SkinAfferent> afferents, std::size_t receptors) {
    if (tuning.gain == 0) return;
    for (auto& g : gains_) g.resize((afferents.size() + tile_width - 1) / tile_width * tile_width * receptors);
    for (std::size_t u = 0; u < afferents.size(); ++u) {
        const auto [x, y] = shear_gains(tuning, afferents[u]);
        for (std::size_t h = 0; h < receptors; ++h) {
            const auto at = index_in_tiles(u * receptors + h, receptors);
            gains_[0][at] = x, gains_[1][at] = y;
        }
    }
}

ForceTiles<double> ShearForce::add(FieldForce& field_force, const SiteForce& force, std::span<const std::uint32_t> touched, std::size_t at,
                                   std::size_t steps, ThreadPool& pool) {
    const std::size_t tiles = gains_[0].size() / tile_width;
    if (rows_.size() == 0) rows_ = lanes::AlignedBuffer<double>(tiles * skin_steps * tile_width);
    // Calls f(tile, rows of field_force, rows of the result, values in a tile) for each tile with force. The three sums have the same ones.
    const auto for_each_tile = [&](const auto& f) {
        const auto sums = field_force.tiles();
        for (std::size_t tile = 0; tile < tiles; ++tile)
            if (const auto from = tile * steps * tile_width; !sums.zero_force[tile]) f(tile, sums.rows + from, rows_.data() + from);
    };
    field_force.compute(force, touched, at, steps, pool);
    for_each_tile([&](std::size_t, const double* sums, double* rows) { std::copy_n(sums, steps * tile_width, rows); });
    const std::array<const double*, 2> components{force.shear_x, force.shear_y};
    for (std::size_t axis = 0; axis < 2; ++axis) {
        if (!components[axis]) continue;
        field_force.compute({components[axis], force.stride, touched, false}, touched, at, steps, pool);
        for_each_tile([&](std::size_t tile, const double* sums, double* rows) {
            const double* const gain = gains_[axis].data() + tile * tile_width;
            for (std::size_t t = 0; t < steps; ++t)
                for (std::size_t u = 0; u < tile_width; ++u) rows[t * tile_width + u] += gain[u] * sums[t * tile_width + u];
        });
    }
    return {rows_.data(), field_force.tiles().zero_force};
}

}  // namespace corpuscle
