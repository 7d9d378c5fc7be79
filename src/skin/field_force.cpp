#include "skin/field_force.hpp"

#include <array>
#include <numeric>

namespace corpuscle {
namespace {

constexpr std::size_t field_steps = 4;  // steps are padded to a multiple of this, so that each afferent's sums begin at a vector

constexpr std::size_t dense_ratio = 2;  // if more than 1 / dense_ratio of the sites are touched, the force is summed afferent by afferent

/// Number of steps with padding.
std::size_t padded(std::size_t steps) { return (steps + field_steps - 1) / field_steps * field_steps; }

/// Transposes the sums of a tile from [afferent][stride] to [step][tile_width].
void transpose(const double* sums, std::size_t stride, std::size_t steps, double* rows) {
    for (std::size_t from = 0; from < steps; from += field_steps)
        for (std::size_t u = 0; u < tile_width; ++u)
            for (std::size_t t = from; t < std::min(from + field_steps, steps); ++t) rows[t * tile_width + u] = sums[u * stride + t];
}

/// Number of forces on `count` afferents, with padding to complete tiles if there are several receptors.
std::size_t force_count(const ReceptiveFields& fields, std::size_t count) {
    return fields.receptors == 1 ? count : (count + tile_width - 1) / tile_width * tile_width * fields.receptors;
}

}  // namespace

FieldForce::FieldForce(const ReceptiveFields& fields, std::size_t first, std::size_t count, std::size_t sites, InstructionSet set)
    : lanes_(lanes::field_kernels(set)), size_(force_count(fields, count)), tiles_((size_ + tile_width - 1) / tile_width),
      pieces_((tiles_ + tiles_per_piece - 1) / tiles_per_piece), rows_(tiles_ * skin_steps * tile_width), zero_force_(tiles_) {
    constexpr std::size_t piece_afferents = tiles_per_piece * tile_width;
    std::vector<std::size_t> counts(pieces_.size());  // entries of each piece
    for (const std::size_t number : fields.afferent)
        if (number >= first * fields.receptors && number < (first + count) * fields.receptors)
            ++counts[index_in_tiles(number - first * fields.receptors, fields.receptors) / piece_afferents];
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
        auto& p = pieces_[k];
        p.begin.reserve(sites + 1), p.begin.assign(1, 0);
        p.afferent.reserve(counts[k]), p.weight.reserve(counts[k]);
    }
    for (std::size_t s = 0; s < sites; ++s) {
        for (std::size_t k = fields.begin[s]; k < fields.begin[s + 1]; ++k) {
            const std::size_t receptors = fields.receptors, number = fields.afferent[k];
            if (number < first * receptors || number >= (first + count) * receptors) continue;
            const std::size_t afferent = index_in_tiles(number - first * receptors, receptors);
            auto& p = pieces_[afferent / piece_afferents];
            p.afferent.push_back(static_cast<std::uint32_t>(afferent % piece_afferents));
            p.weight.push_back(fields.weight[k]);
        }
        for (auto& p : pieces_) p.begin.push_back(static_cast<std::uint32_t>(p.afferent.size()));
    }
}

void FieldForce::compute(const SiteForce& force, std::span<const std::uint32_t> touched, std::size_t at, std::size_t steps,
                         ThreadPool& pool) {
    const Call call{force, touched, at, steps};
    if (steps == 1) return compute_one_step(call);
    // Piece::begin has one element for each site and one more.
    if (touched.size() * dense_ratio > pieces_[0].begin.size()) return compute_by_afferent(call, pool);
    while (sums_.size() < pool.threads()) sums_.emplace_back(tiles_per_piece * tile_width * skin_steps);
    pool.for_each(pieces_.size(), [&call, this](std::size_t piece, unsigned thread) { compute_piece(piece, call, sums_[thread].data()); });
}

void FieldForce::build_by_afferent() {
    auto& [begin, site, weight] = by_afferent_;
    // Calls add(afferent, site, weight) for each site of each receptive field, for each afferent in the order of the sites.
    const auto for_each_entry = [this](const auto& add) {
        for (std::size_t n = 0; n < pieces_.size(); ++n)
            for (std::uint32_t s = 0; s + 1 < pieces_[n].begin.size(); ++s)
                for (std::size_t k = pieces_[n].begin[s]; k < pieces_[n].begin[s + 1]; ++k)
                    add(n * tiles_per_piece * tile_width + pieces_[n].afferent[k], s, pieces_[n].weight[k]);
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
    site_rows_.assign(pieces_[0].begin.size() - 1, zero.data());
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
    const auto& p = pieces_[piece];
    const std::size_t first = piece * tiles_per_piece, tiles = std::min(tiles_per_piece, tiles_ - first), stride = padded(steps);
    auto* zero_force = zero_force_.data() + first;
    std::fill_n(zero_force, tiles, std::uint8_t{1});
    double* rows = rows_.data() + first * steps * tile_width;
    for (const auto s : touched) {
        const std::size_t begin = p.begin[s], end = p.begin[s + 1];
        for (std::size_t k = begin; k < end; ++k)
            if (const auto tile = p.afferent[k] / tile_width; zero_force[tile])
                std::fill_n(sums + tile * tile_width * stride, tile_width * stride, 0.0), zero_force[tile] = 0;
        lanes_.add_site(p.afferent.data() + begin, p.weight.data() + begin, end - begin, force.data + s * force.stride + at, steps, sums,
                        stride);
    }
    for (std::size_t tile = 0; tile < tiles; ++tile)
        if (!zero_force[tile]) transpose(sums + tile * tile_width * stride, stride, steps, rows + tile * steps * tile_width);
}

}  // namespace corpuscle
