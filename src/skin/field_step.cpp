// Receptive fields at a single step. The same sums in the same order as over many, to the bit.

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "skin/field.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t side_by_side = 8;  // sums in registers: side by side they are no chain
constexpr std::size_t margin = force_tile;

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

/// What one tile feels, if its units stand as the sites do: neighbours feel neighbours.
void FeltForce::make_tile(std::size_t tile, std::size_t sites, Eights& eights) {
    const auto& p = pieces_[tile / piece_tiles];
    const std::size_t first = tile % piece_tiles * force_tile;
    struct Entry {
        std::ptrdiff_t row;
        std::size_t unit;
        double weight;
    };
    std::vector<Entry> felt;
    std::vector<std::size_t> counts(force_tile);
    std::map<std::ptrdiff_t, std::size_t> rows;  // by the site of their first unit
    for (std::uint32_t s = 0; s < sites; ++s)
        for (std::size_t k = p.begin[s]; k < p.begin[s + 1]; ++k) {
            if (p.unit[k] < first || p.unit[k] >= first + force_tile) continue;
            const std::size_t unit = p.unit[k] - first;
            felt.push_back({static_cast<std::ptrdiff_t>(s) - static_cast<std::ptrdiff_t>(unit), unit, p.weight[k]});
            rows[felt.back().row] = 0, ++counts[unit];
        }
    const auto most = *std::max_element(counts.begin(), counts.end());
    if (rows.size() > most + most / 2) return;
    auto& out = one_step_[tile];
    for (auto& [row, k] : rows) k = out.row.size(), out.row.push_back(row);
    std::vector<double> weights(rows.size() * force_tile);
    for (const auto& e : felt) weights[rows[e.row] * force_tile + e.unit] = e.weight;
    for (std::size_t k = 0; k < weights.size(); k += side_by_side) out.weights.push_back(eights.place(weights.data() + k));
}

void FeltForce::make_one_step() {
    const std::size_t sites = pieces_[0].begin.size() - 1;
    now_.assign(sites + 2 * margin, 0);
    one_step_.resize(tiles_);
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

void FeltForce::feel_one_step(const Call& call) {
    if (one_step_.empty()) make_one_step();
    const bool all = call.touched.size() == now_.size() - 2 * margin;
    double* const now = now_.data() + margin;
    const double* const force = call.force.of + call.at;
    if (all && call.force.stride == 1)
        std::copy_n(force, call.touched.size(), now);
    else
        for (const auto s : call.touched) now[s] = force[s * call.force.stride];
    std::fill(without_.begin(), without_.end(), static_cast<std::uint8_t>(!all));  // every unit feels some site
    if (!all)
        for (const auto s : call.touched)
            for (std::size_t k = reach_begin_[s]; k < reach_begin_[s + 1]; ++k) without_[reach_[k]] = 0;
    bool in_rows = true;
    for (std::size_t t = 0; t < tiles_; ++t) {
        if (without_[t]) continue;
        const auto& tile = one_step_[t];
        double* const sums = rows_.data() + t * force_tile;
        in_rows &= !tile.row.empty();
        if (tile.row.empty())
            std::fill_n(sums, force_tile, 0.0);
        else
            add_rows(tile.row, tile.weights.data(), weights_.data(), now, sums);
    }
    if (!in_rows) feel_site_by_site(call);
    for (const auto s : call.touched) now[s] = 0;
}

/// The tiles that are in no rows: each site gives its share to all who feel it.
void FeltForce::feel_site_by_site(const Call& call) {
    for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
        const auto& p = pieces_[piece];
        double* const sums = rows_.data() + piece * piece_tiles * force_tile;
        const OneStep* const tiles = one_step_.data() + piece * piece_tiles;
        for (const auto s : call.touched) {
            const double f = call.force.of[s * call.force.stride + call.at];
            for (std::size_t k = p.begin[s]; k < p.begin[s + 1]; ++k)
                if (tiles[p.unit[k] / force_tile].row.empty()) sums[p.unit[k]] += p.weight[k] * f;
        }
    }
}

}  // namespace corpuscle
