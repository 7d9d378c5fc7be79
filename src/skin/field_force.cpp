#include "skin/field_force.hpp"

#include <array>
#include <numeric>

namespace corpuscle {
namespace {

constexpr std::size_t field_steps = 4;  // steps are padded to a multiple of this, so that each afferent's sums begin at a vector

constexpr std::size_t dense_ratio = 2;  // if more than 1 / dense_ratio of the sites are touched, the force is summed afferent by afferent

/// Number of steps with padding.
std::size_t padded(std::size_t steps) { return (steps + field_steps - 1) / field_steps * field_steps; }

}  // namespace

FieldForce::FieldForce(const ReceptiveFields& fields, std::size_t first, std::size_t count, InstructionSet set)
    : lanes_(lanes::field_kernels(set)), pieces_(fields, first, count, tiles_per_piece * tile_width), size_(pieces_.forces()),
      tiles_((size_ + tile_width - 1) / tile_width), rows_(tiles_ * skin_steps * tile_width), zero_force_(tiles_) {}

void FieldForce::compute(const SiteForce& force, std::span<const std::uint32_t> touched, std::size_t at, std::size_t steps,
                         ThreadPool& pool) {
    const Call call{force, touched, at, steps};
    if (steps == 1) return compute_one_step(call);
    if (touched.size() * dense_ratio > pieces_.sites() + 1) return compute_by_afferent(call, pool);
    while (sums_.size() < pool.threads()) sums_.emplace_back(tiles_per_piece * tile_width * skin_steps);
    pool.for_each(pieces_.pieces(),
                  [&call, this](std::size_t piece, unsigned thread) { compute_piece(piece, call, sums_[thread].data()); });
}

void FieldForce::build_by_afferent() {
    auto& begin = by_afferent_.begin;
    auto& site = by_afferent_.site;
    auto& weight = by_afferent_.weight;
    // Calls add(afferent, site, weight) for each site of each receptive field, for each afferent in the order of the sites.
    const auto for_each_entry = [this](const auto& add) {
        for (std::size_t n = 0; n < pieces_.pieces(); ++n)
            for (std::uint32_t s = 0; s < pieces_.sites(); ++s) {
                const auto e = pieces_.at(n, s);
                for (std::size_t k = 0; k < e.count; ++k) add(n * tiles_per_piece * tile_width + e.afferent[k] - e.origin, s, e.weight[k]);
            }
    };
    begin.assign(size_ + 1, 0);
    for_each_entry([&](std::size_t afferent, std::uint32_t, double) { ++begin[afferent + 1]; });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    site.resize(begin.back()), weight.resize(begin.back());
    auto next = begin;
    for_each_entry([&](std::size_t afferent, std::uint32_t s, double w) {
        const auto k = next[afferent]++;
        site[k] = s, weight[k] = w;
    });
}

/// Computes the force afferent by afferent, for every tile. This method is used when many sites are touched, so few tiles are without
/// force.
void FieldForce::compute_by_afferent(const Call& call, ThreadPool& pool) {
    static constexpr std::array<double, skin_steps> zero = {};
    if (by_afferent_.begin.empty()) build_by_afferent();
    site_rows_.assign(pieces_.sites(), zero.data());
    for (const auto s : call.touched) site_rows_[s] = call.force.data + s * call.force.stride + call.at;
    std::fill(zero_force_.begin(), zero_force_.end(), std::uint8_t{0});
    pool.for_each(tiles_, [&call, this](std::size_t tile, unsigned) { compute_tile(tile, call.steps); });
}

/// Computes the force on the afferents of a tile from site_rows_. The sums equal those of the other methods bit for bit.
void FieldForce::compute_tile(std::size_t tile, std::size_t steps) {
    const std::size_t first = tile * tile_width, size = std::min(tile_width, size_ - first);
    double* const rows = rows_.data() + first * steps;
    if (size < tile_width) std::fill_n(rows, steps * tile_width, 0.0);
    for (std::size_t u = 0; u < size; ++u) {
        const auto begin = by_afferent_.begin[first + u], count = by_afferent_.begin[first + u + 1] - begin;
        lanes_.sum_afferent(by_afferent_.site.data() + begin, by_afferent_.weight.data() + begin, count, site_rows_.data(), steps, rows + u,
                            tile_width);
    }
}

/// Computes the force on the afferents of a piece, site by site. `sums` is the thread's scratch array.
void FieldForce::compute_piece(std::size_t piece, const Call& call, double* sums) {
    const auto& [force, touched, at, steps] = call;
    const std::size_t first = piece * tiles_per_piece, tiles = std::min(tiles_per_piece, tiles_ - first), stride = padded(steps);
    auto* zero_force = zero_force_.data() + first;
    std::fill_n(zero_force, tiles, std::uint8_t{1});
    double* rows = rows_.data() + first * steps * tile_width;
    for (const auto s : touched) {
        const auto e = pieces_.at(piece, s);
        for (std::size_t k = 0; k < e.count; ++k)
            if (const auto tile = (e.afferent[k] - e.origin) / tile_width; zero_force[tile])
                std::fill_n(sums + tile * tile_width * stride, tile_width * stride, 0.0), zero_force[tile] = 0;
        lanes_.add_site(e.afferent, e.weight, e.count, e.origin, force.data + s * force.stride + at, steps, sums, stride);
    }
    std::array<const double*, tile_width> columns{};
    for (std::size_t tile = 0; tile < tiles; ++tile) {
        if (zero_force[tile]) continue;
        for (std::size_t u = 0; u < tile_width; ++u) columns[u] = sums + (tile * tile_width + u) * stride;
        lanes_.transpose(columns.data(), steps, nullptr, 0, rows + tile * steps * tile_width);
    }
}

}  // namespace corpuscle
