// Receptive fields at a single step. The sums and their order are those of several steps, bit for bit.

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "skin/field.hpp"

namespace corpuscle {
namespace {

using lanes::eight;

constexpr std::size_t margin = force_tile;

}  // namespace

/// Groups of eight weights, each distinct group stored once. Most are equal where afferents are alike.
class FeltForce::Eights {
    std::map<std::array<double, eight>, std::uint32_t> index_;

public:
    std::vector<double> all = {};
    std::uint32_t index_of(const double* weights) {
        std::array<double, eight> group;
        std::copy_n(weights, eight, group.begin());
        const auto [at, is_new] = index_.try_emplace(group, static_cast<std::uint32_t>(all.size()));
        if (is_new) all.insert(all.end(), group.begin(), group.end());
        return at->second;
    }
};

/// Builds the rows of one tile, if its afferents are arranged like the sites, so that neighbours respond to neighbouring sites.
void FeltForce::make_tile(std::size_t tile, std::size_t sites, Eights& eights) {
    const auto& p = pieces_[tile / piece_tiles];
    const std::size_t first = tile % piece_tiles * force_tile;
    struct Entry {
        std::ptrdiff_t row;
        std::size_t afferent;
        double weight;
    };
    std::vector<Entry> entries;
    std::vector<std::size_t> counts(force_tile);
    std::map<std::ptrdiff_t, std::size_t> rows;  // by the site of their first afferent
    for (std::uint32_t s = 0; s < sites; ++s)
        for (std::size_t k = p.begin[s]; k < p.begin[s + 1]; ++k) {
            if (p.unit[k] < first || p.unit[k] >= first + force_tile) continue;
            const std::size_t afferent = p.unit[k] - first;
            entries.push_back({static_cast<std::ptrdiff_t>(s) - static_cast<std::ptrdiff_t>(afferent), afferent, p.weight[k]});
            rows[entries.back().row] = 0, ++counts[afferent];
        }
    const auto max_count = *std::max_element(counts.begin(), counts.end());
    if (rows.size() > max_count + max_count / 2) return;
    auto& out = one_step_[tile];
    for (auto& [row, k] : rows) k = out.row.size(), out.row.push_back(row);
    std::vector<double> weights(rows.size() * force_tile);
    for (const auto& e : entries) weights[rows[e.row] * force_tile + e.afferent] = e.weight;
    for (std::size_t k = 0; k < weights.size(); k += eight) out.weights.push_back(eights.index_of(weights.data() + k));
}

void FeltForce::make_one_step() {
    const std::size_t sites = pieces_[0].begin.size() - 1;
    now_.assign(sites + 2 * margin, 0);
    one_step_.resize(tiles_);
    Eights eights;
    for (std::size_t t = 0; t < tiles_; ++t) make_tile(t, sites, eights);
    in_rows_.assign(pieces_.size(), 1);
    for (std::size_t t = 0; t < tiles_; ++t)
        if (one_step_[t].row.empty()) in_rows_[t / piece_tiles] = 0;
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
    std::fill(without_.begin(), without_.end(), static_cast<std::uint8_t>(!all));  // every afferent responds to some site
    if (!all)
        for (const auto s : call.touched)
            for (std::size_t k = reach_begin_[s]; k < reach_begin_[s + 1]; ++k) without_[reach_[k]] = 0;
    double* const now = now_.data() + margin;
    const double* const force = call.force.of + call.at;
    if (all && call.force.stride == 1)
        std::copy_n(force, call.touched.size(), now);
    else
        for (const auto s : call.touched) now[s] = force[s * call.force.stride];
    for (std::size_t piece = 0; piece < pieces_.size(); ++piece)
        in_rows_[piece] ? feel_in_rows(piece, now) : feel_site_by_site(piece, call);
    if (all)
        std::fill_n(now, call.touched.size(), 0.0);
    else
        for (const auto s : call.touched) now[s] = 0;
}

void FeltForce::feel_in_rows(std::size_t piece, const double* now) {
    for (std::size_t t = piece * piece_tiles; t < std::min(tiles_, (piece + 1) * piece_tiles); ++t)
        if (const auto& tile = one_step_[t]; !without_[t])
            lanes_.add_rows(tile.row.data(), tile.row.size(), tile.weights.data(), weights_.data(), now, rows_.data() + t * force_tile);
}

/// Adds the contribution of each site to all afferents that respond to it.
void FeltForce::feel_site_by_site(std::size_t piece, const Call& call) {
    const auto& p = pieces_[piece];
    const std::size_t first = piece * piece_tiles, tiles = std::min(piece_tiles, tiles_ - first);
    double* const sums = rows_.data() + first * force_tile;
    bool any = false;
    for (std::size_t t = 0; t < tiles; ++t)
        if (!without_[first + t]) std::fill_n(sums + t * force_tile, force_tile, 0.0), any = true;
    if (!any) return;
    for (const auto s : call.touched) {
        const double f = call.force.of[s * call.force.stride + call.at];
        for (std::size_t k = p.begin[s]; k < p.begin[s + 1]; ++k) sums[p.unit[k]] += p.weight[k] * f;
    }
}

}  // namespace corpuscle
