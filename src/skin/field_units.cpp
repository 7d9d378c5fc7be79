// Receptive fields unit by unit: a unit's whole sum at a time, in registers, and not each site's share in many. The same sums in the same
// order, to the bit.

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "skin/field.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t side_by_side = 8;  // sums in registers: side by side they are no chain
constexpr std::size_t margin = force_tile;

/// Each unit's sites, wherever they are.
void add_up(std::size_t most, const std::uint32_t* site, const std::uint32_t* weights, const double* all, const double* now, double* sums) {
    for (std::size_t u = 0; u < force_tile; u += side_by_side) {
        double sum[side_by_side] = {};
        for (std::size_t k = 0; k < most; ++k) {
            const auto* const s = site + k * force_tile + u;
            const double* const w = all + weights[(k * force_tile + u) / side_by_side];
            for (std::size_t i = 0; i < side_by_side; ++i) sum[i] += w[i] * now[s[i]];
        }
        for (std::size_t i = 0; i < side_by_side; ++i) sums[u + i] = sum[i];
    }
}

/// A site that a unit feels, over some steps.
struct FeltSite {
    const double* force;
    double weight;
};

/// One unit's sites over some steps; into every force_tile-th of `sums`.
void add_steps(std::span<const FeltSite> sites, std::size_t steps, double* sums) {
    constexpr std::size_t at_once = 16;
    std::size_t from = 0;
    for (; from + at_once <= steps; from += at_once) {
        double sum[at_once] = {};
        for (const auto& s : sites)
            for (std::size_t i = 0; i < at_once; ++i) sum[i] += s.weight * s.force[from + i];
        for (std::size_t i = 0; i < at_once; ++i) sums[(from + i) * force_tile] = sum[i];
    }
    for (; from < steps; ++from) {
        double sum = 0;
        for (const auto& s : sites) sum += s.weight * s.force[from];
        sums[from * force_tile] = sum;
    }
}

/// Sites in rows.
void add_rows(std::span<const std::ptrdiff_t> rows, const std::uint32_t* weights, const double* all, const double* now, double* sums) {
    for (std::size_t u = 0; u < force_tile; u += side_by_side) {
        double sum[side_by_side] = {};
        for (std::size_t k = 0; k < rows.size(); ++k) {
            const double* const f = now + rows[k] + u;
            const double* const w = all + weights[(k * force_tile + u) / side_by_side];
            for (std::size_t i = 0; i < side_by_side; ++i) sum[i] += w[i] * f[i];
        }
        for (std::size_t i = 0; i < side_by_side; ++i) sums[u + i] = sum[i];
    }
}

}  // namespace

/// Eight weights side by side, each eight kept once: where units are alike, most are.
class FeltForce::Eights {
    std::map<std::array<double, side_by_side>, std::uint32_t> place_;

public:
    std::vector<double> all = {};
    std::uint32_t place(const double* of) {
        std::array<double, side_by_side> eight;
        std::copy_n(of, side_by_side, eight.begin());
        const auto [at, is_new] = place_.try_emplace(eight, static_cast<std::uint32_t>(all.size()));
        if (is_new) all.insert(all.end(), eight.begin(), eight.end());
        return at->second;
    }
};

/// What one tile feels. Where its units stand as the sites do, as on a grid, those of a k are neighbours: they are in a row then.
void FeltForce::make_tile(std::size_t tile, std::size_t sites, Eights& eights) {
    const auto& p = pieces_[tile / piece_tiles];
    const std::size_t first = tile % piece_tiles * force_tile;
    std::vector<std::vector<std::pair<std::uint32_t, double>>> felt(force_tile);
    std::map<std::ptrdiff_t, std::size_t> rows;  // by the site of their first unit
    std::size_t most = 0;
    for (std::uint32_t s = 0; s < sites; ++s)
        for (std::size_t k = p.begin[s]; k < p.begin[s + 1]; ++k) {
            const std::size_t unit = p.unit[k] - first;
            if (p.unit[k] < first || unit >= force_tile) continue;
            felt[unit].emplace_back(s, p.weight[k]);
            rows[static_cast<std::ptrdiff_t>(s) - static_cast<std::ptrdiff_t>(unit)] = 0;
            most = std::max(most, felt[unit].size());
        }
    auto& out = unit_by_unit_[tile];
    const bool in_rows = rows.size() <= most + most / 2;
    if (in_rows)
        for (auto& [row, k] : rows) k = out.row.size(), out.row.push_back(row);
    out.most = in_rows ? rows.size() : most;
    std::vector<double> weights(out.most * force_tile);
    if (!in_rows) out.site = lanes::Buffer<std::uint32_t>(out.most * force_tile);
    for (std::size_t u = 0; u < force_tile; ++u)
        for (std::size_t n = 0; n < felt[u].size(); ++n) {
            const auto [s, weight] = felt[u][n];
            const auto k = in_rows ? rows[static_cast<std::ptrdiff_t>(s) - static_cast<std::ptrdiff_t>(u)] : n;
            weights[k * force_tile + u] = weight;
            if (!in_rows) out.site.data()[k * force_tile + u] = s;
        }
    for (std::size_t k = 0; k < weights.size(); k += side_by_side) out.weights.push_back(eights.place(weights.data() + k));
}

void FeltForce::make_unit_by_unit() {
    const std::size_t sites = pieces_[0].begin.size() - 1;
    now_.assign(sites + 2 * margin, 0);
    unit_by_unit_.resize(tiles_);
    Eights eights;
    for (std::size_t t = 0; t < tiles_; ++t) make_tile(t, sites, eights);
    weights_ = lanes::Buffer<double>(eights.all.size());
    std::copy(eights.all.begin(), eights.all.end(), weights_.data());
    std::vector<std::uint32_t> last(tiles_, std::uint32_t(-1));
    reach_begin_.assign(1, 0);
    for (std::uint32_t s = 0; s < sites; ++s) {
        for (std::size_t p = 0; p < pieces_.size(); ++p)
            for (std::size_t k = pieces_[p].begin[s]; k < pieces_[p].begin[s + 1]; ++k) {
                const std::size_t t = p * piece_tiles + pieces_[p].unit[k] / force_tile;
                if (std::exchange(last[t], s) != s) reach_.push_back(static_cast<std::uint32_t>(t));
            }
        reach_begin_.push_back(reach_.size());
    }
}

void FeltForce::find_touched_tiles(const Call& call) {
    if (unit_by_unit_.empty()) make_unit_by_unit();
    const bool all = call.touched.size() == now_.size() - 2 * margin;
    std::fill(without_.begin(), without_.end(), static_cast<std::uint8_t>(!all));  // every unit feels some site
    if (all) return;
    for (const auto s : call.touched)
        for (std::size_t k = reach_begin_[s]; k < reach_begin_[s + 1]; ++k) without_[reach_[k]] = 0;
}

void FeltForce::feel_one_step(const Call& call) {
    find_touched_tiles(call);
    double* const now = now_.data() + margin;
    const double* const force = call.force.of + call.at;
    if (call.force.stride == 1 && call.touched.size() == now_.size() - 2 * margin)
        std::copy_n(force, call.touched.size(), now);
    else
        for (const auto s : call.touched) now[s] = force[s * call.force.stride];
    for (std::size_t t = 0; t < tiles_; ++t) {
        if (without_[t]) continue;
        const auto& tile = unit_by_unit_[t];
        double* const sums = rows_.data() + t * force_tile;
        if (tile.row.empty())
            add_up(tile.most, tile.site.data(), tile.weights.data(), weights_.data(), now, sums);
        else
            add_rows(tile.row, tile.weights.data(), weights_.data(), now, sums);
    }
    for (const auto s : call.touched) now[s] = 0;
}

/// Some steps, where much of the skin is touched.
void FeltForce::feel_unit_by_unit(const Call& call, Pool& pool) {
    static constexpr std::array<double, skin_steps> nothing = {};
    find_touched_tiles(call);
    site_rows_.assign(now_.size(), nothing.data());
    for (const auto s : call.touched) site_rows_[margin + s] = call.force.of + s * call.force.stride + call.at;
    pool.each(tiles_, [&call, this](std::size_t t, unsigned) {
        if (without_[t]) return;
        const auto& tile = unit_by_unit_[t];
        double* const rows = rows_.data() + t * call.steps * force_tile;
        std::vector<FeltSite> felt(tile.most);
        for (std::size_t u = 0; u < force_tile; ++u) {
            for (std::size_t k = 0; k < tile.most; ++k) {
                const auto s = tile.row.empty() ? static_cast<std::ptrdiff_t>(tile.site.data()[k * force_tile + u])
                                                : tile.row[k] + static_cast<std::ptrdiff_t>(u);
                felt[k] = {site_rows_[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(margin) + s)],
                           weights_.data()[tile.weights[(k * force_tile + u) / side_by_side] + u % side_by_side]};
            }
            add_steps(felt, call.steps, rows + u);
        }
    });
}

}  // namespace corpuscle
