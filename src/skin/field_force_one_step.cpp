// Receptive fields at a single step. The sums equal those of several steps bit for bit, because the order of their terms is the same.

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "skin/field_force.hpp"

namespace corpuscle {
namespace {

using lanes::group_size;

constexpr std::size_t margin = tile_width;

}  // namespace

/// Groups of eight weights, each distinct group stored once. Few are distinct if many receptive fields have the same shape.
class FieldForce::WeightGroups {
    std::map<std::array<double, group_size>, std::uint32_t> index_;

public:
    std::vector<double> all = {};
    std::uint32_t index_of(const double* weights) {
        std::array<double, group_size> group;
        std::copy_n(weights, group_size, group.begin());
        const auto [at, is_new] = index_.try_emplace(group, static_cast<std::uint32_t>(all.size()));
        if (is_new) all.insert(all.end(), group.begin(), group.end());
        return at->second;
    }
};

/// Builds the rows of one tile, if its afferents are arranged like the sites, so that neighbours respond to neighbouring sites.
void FieldForce::build_tile(std::size_t tile, std::size_t sites, WeightGroups& groups) {
    const auto& p = pieces_[tile / tiles_per_piece];
    const std::size_t first = tile % tiles_per_piece * tile_width;
    struct Entry {
        std::ptrdiff_t row;
        std::size_t afferent;
        double weight;
    };
    std::vector<Entry> entries;
    std::vector<std::size_t> counts(tile_width);
    std::map<std::ptrdiff_t, std::size_t> rows;  // from OneStep::row to its index k
    for (std::uint32_t s = 0; s < sites; ++s)
        for (std::size_t k = p.begin[s]; k < p.begin[s + 1]; ++k) {
            if (p.afferent[k] < first || p.afferent[k] >= first + tile_width) continue;
            const std::size_t afferent = p.afferent[k] - first;
            entries.push_back({static_cast<std::ptrdiff_t>(s) - static_cast<std::ptrdiff_t>(afferent), afferent, p.weight[k]});
            rows[entries.back().row] = 0, ++counts[afferent];
        }
    const auto max_count = *std::max_element(counts.begin(), counts.end());
    if (rows.size() > max_count + max_count / 2) return;
    auto& out = one_step_[tile];
    for (auto& [row, k] : rows) k = out.row.size(), out.row.push_back(row);
    std::vector<double> weights(rows.size() * tile_width);
    for (const auto& e : entries) weights[rows[e.row] * tile_width + e.afferent] = e.weight;
    for (std::size_t k = 0; k < weights.size(); k += group_size) out.weights.push_back(groups.index_of(weights.data() + k));
}

void FieldForce::build_one_step() {
    const std::size_t sites = pieces_[0].begin.size() - 1;
    padded_force_.assign(sites + 2 * margin, 0);
    one_step_.resize(tiles_);
    WeightGroups groups;
    for (std::size_t t = 0; t < tiles_; ++t) build_tile(t, sites, groups);
    has_rows_.assign(pieces_.size(), 1);
    for (std::size_t t = 0; t < tiles_; ++t)
        if (one_step_[t].row.empty()) has_rows_[t / tiles_per_piece] = 0;
    weights_ = lanes::AlignedBuffer<double>(groups.all.size());
    std::copy(groups.all.begin(), groups.all.end(), weights_.data());
    std::vector<std::uint32_t> last(tiles_, std::uint32_t(-1));
    responding_begin_.assign(1, 0);
    for (std::uint32_t s = 0; s < sites; ++s) {
        for (std::size_t p = 0; p < pieces_.size(); ++p)
            for (std::size_t k = pieces_[p].begin[s]; k < pieces_[p].begin[s + 1]; ++k) {
                const std::size_t t = p * tiles_per_piece + pieces_[p].afferent[k] / tile_width;
                if (std::exchange(last[t], s) != s) responding_tiles_.push_back(static_cast<std::uint32_t>(t));
            }
        responding_begin_.push_back(responding_tiles_.size());
    }
}

void FieldForce::compute_one_step(const Call& call) {
    if (one_step_.empty()) build_one_step();
    const bool all = call.touched.size() == padded_force_.size() - 2 * margin;
    std::fill(zero_force_.begin(), zero_force_.end(), static_cast<std::uint8_t>(!all));  // every afferent responds to some site
    if (!all)
        for (const auto s : call.touched)
            for (std::size_t k = responding_begin_[s]; k < responding_begin_[s + 1]; ++k) zero_force_[responding_tiles_[k]] = 0;
    double* const now = padded_force_.data() + margin;
    const double* const force = call.force.data + call.at;
    if (all && call.force.stride == 1)
        std::copy_n(force, call.touched.size(), now);
    else
        for (const auto s : call.touched) now[s] = force[s * call.force.stride];
    for (std::size_t piece = 0; piece < pieces_.size(); ++piece)
        has_rows_[piece] ? compute_rows(piece, now) : compute_site_by_site(piece, call);
    if (all)
        std::fill_n(now, call.touched.size(), 0.0);
    else
        for (const auto s : call.touched) now[s] = 0;
}

void FieldForce::compute_rows(std::size_t piece, const double* now) {
    for (std::size_t t = piece * tiles_per_piece; t < std::min(tiles_, (piece + 1) * tiles_per_piece); ++t)
        if (const auto& tile = one_step_[t]; !zero_force_[t])
            lanes_.sum_rows(tile.row.data(), tile.row.size(), tile.weights.data(), weights_.data(), now, rows_.data() + t * tile_width);
}

/// Adds the contribution of each site to all afferents that respond to it.
void FieldForce::compute_site_by_site(std::size_t piece, const Call& call) {
    const auto& p = pieces_[piece];
    const std::size_t first = piece * tiles_per_piece, tiles = std::min(tiles_per_piece, tiles_ - first);
    double* const sums = rows_.data() + first * tile_width;
    bool any = false;
    for (std::size_t t = 0; t < tiles; ++t)
        if (!zero_force_[first + t]) std::fill_n(sums + t * tile_width, tile_width, 0.0), any = true;
    if (!any) return;
    for (const auto s : call.touched) {
        const double f = call.force.data[s * call.force.stride + call.at];
        for (std::size_t k = p.begin[s]; k < p.begin[s + 1]; ++k) sums[p.afferent[k]] += p.weight[k] * f;
    }
}

}  // namespace corpuscle
