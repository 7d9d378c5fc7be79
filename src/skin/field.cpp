#include "skin/field.hpp"

#include <algorithm>
#include <array>

namespace corpuscle {
namespace {

constexpr std::size_t field_steps = 4;  // rows of sums are padded to a multiple of this, to begin on whole vectors

constexpr std::size_t dense = 2;  // by_afferent is used if more than one site in this many is touched

std::size_t padded(std::size_t steps) { return (steps + field_steps - 1) / field_steps * field_steps; }

/// Transposes [afferent][step] to [step][afferent].
void transpose(const double* sums, std::size_t stride, std::size_t steps, double* rows) {
    for (std::size_t from = 0; from < steps; from += field_steps)
        for (std::size_t u = 0; u < force_tile; ++u)
            for (std::size_t t = from; t < std::min(from + field_steps, steps); ++t) rows[t * force_tile + u] = sums[u * stride + t];
}

}  // namespace

FeltForce::FeltForce(const ReceptiveFields& fields, std::size_t first, std::size_t count, std::size_t sites, InstructionSet set)
    : lanes_(lanes::field_lanes(set)), units_(count), tiles_((count + force_tile - 1) / force_tile),
      pieces_((tiles_ + piece_tiles - 1) / piece_tiles), rows_(tiles_ * skin_steps * force_tile), without_(tiles_) {
    constexpr std::size_t piece_units = piece_tiles * force_tile;
    for (auto& p : pieces_) p.begin.assign(1, 0);
    for (std::size_t s = 0; s < sites; ++s) {
        for (std::size_t k = fields.begin[s]; k < fields.begin[s + 1]; ++k) {
            const std::size_t afferent = fields.unit[k];
            if (afferent < first || afferent >= first + count) continue;
            auto& p = pieces_[(afferent - first) / piece_units];
            p.unit.push_back(static_cast<std::uint32_t>((afferent - first) % piece_units));
            p.weight.push_back(fields.weight[k]);
        }
        for (auto& p : pieces_) p.begin.push_back(static_cast<std::uint32_t>(p.unit.size()));
    }
}

void FeltForce::feel(const SiteForce& force, std::span<const std::uint32_t> touched, std::size_t at, std::size_t steps, ThreadPool& pool) {
    const Call call{force, touched, at, steps};
    if (steps == 1) return feel_one_step(call);
    if (touched.size() * dense > pieces_[0].begin.size()) return feel_by_unit(call, pool);
    while (sums_.size() < pool.threads()) sums_.emplace_back(piece_tiles * force_tile * skin_steps);
    pool.for_each(pieces_.size(), [&call, this](std::size_t piece, unsigned thread) { feel_piece(piece, call, sums_[thread].data()); });
}

void FeltForce::make_by_unit() {
    const std::size_t sites = pieces_[0].begin.size() - 1;
    by_unit_.emplace(units_, lanes_);
    for (std::size_t n = 0; n < pieces_.size(); ++n)
        for (const auto afferent : pieces_[n].unit) by_unit_->count(n * piece_tiles * force_tile + afferent);
    by_unit_->counted();
    for (std::size_t n = 0; n < pieces_.size(); ++n)
        for (std::uint32_t s = 0; s < sites; ++s)
            for (std::size_t k = pieces_[n].begin[s]; k < pieces_[n].begin[s + 1]; ++k)
                by_unit_->add(n * piece_tiles * force_tile + pieces_[n].unit[k], s, pieces_[n].weight[k]);
}

/// All tiles are computed: with so many touched sites few would be without force.
void FeltForce::feel_by_unit(const Call& call, ThreadPool& pool) {
    static constexpr std::array<double, skin_steps> zero = {};
    if (!by_unit_) make_by_unit();
    site_rows_.assign(pieces_[0].begin.size() - 1, zero.data());
    for (const auto s : call.touched) site_rows_[s] = call.force.of + s * call.force.stride + call.at;
    std::fill(without_.begin(), without_.end(), std::uint8_t{0});
    pool.for_each(tiles_, [&call, this](std::size_t tile, unsigned) {
        by_unit_->feel_tile(tile, site_rows_, call.steps, rows_.data() + tile * call.steps * force_tile);
    });
}

void FeltForce::feel_piece(std::size_t piece, const Call& call, double* sums) {
    const auto& [force, touched, at, steps] = call;
    const auto& p = pieces_[piece];
    const std::size_t first = piece * piece_tiles, tiles = std::min(piece_tiles, tiles_ - first), stride = padded(steps);
    auto* without = without_.data() + first;
    std::fill_n(without, tiles, std::uint8_t{1});
    double* rows = rows_.data() + first * steps * force_tile;
    for (const auto s : touched) {
        const std::size_t begin = p.begin[s], end = p.begin[s + 1];
        for (std::size_t k = begin; k < end; ++k)
            if (const auto tile = p.unit[k] / force_tile; without[tile])
                std::fill_n(sums + tile * force_tile * stride, force_tile * stride, 0.0), without[tile] = 0;
        lanes_.add_site(p.unit.data() + begin, p.weight.data() + begin, end - begin, force.of + s * force.stride + at, steps, sums, stride);
    }
    for (std::size_t tile = 0; tile < tiles; ++tile)
        if (!without[tile]) transpose(sums + tile * force_tile * stride, stride, steps, rows + tile * steps * force_tile);
}

}  // namespace corpuscle
