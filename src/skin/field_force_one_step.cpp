// FieldForce for a single step. The sums equal those of several steps bit for bit, because the order of their terms is the same.

#include <array>
#include <map>

#include "skin/field_force.hpp"

namespace corpuscle {
namespace {

using lanes::group_size;

constexpr std::size_t margin = tile_width;  // zeros before and after the force in padded_force_, since row[k] + u may not be a site

}  // namespace

/// Collects groups of eight weights, each distinct group once. Few are distinct if many receptive fields have the same shape.
class FieldForce::WeightGroups {
    std::map<std::array<double, group_size>, std::uint32_t> index_;

public:
    std::vector<double> all = {};  ///< the distinct groups, one after another
    /// The index in `all` of the first weight of this group, which is added if it is new.
    std::uint32_t index_of(const double* weights) {
        std::array<double, group_size> group;
        std::copy_n(weights, group_size, group.begin());
        const auto [at, is_new] = index_.try_emplace(group, static_cast<std::uint32_t>(all.size()));
        if (is_new) all.insert(all.end(), group.begin(), group.end());
        return at->second;
    }
};

/// Builds the rows of one tile, if its afferents are arranged like the sites. This is so if they need at most 1.5 times as many rows as the
/// largest receptive field has sites.
void FieldForce::build_tile(std::size_t tile, WeightGroups& groups) {
    const std::size_t first = tile % tiles_per_piece * tile_width;
    struct Entry {
        std::ptrdiff_t row;    // site - afferent
        std::size_t afferent;  // in the tile
        double weight;
    };
    std::vector<Entry> entries;
    std::vector<std::size_t> counts(tile_width);  // number of sites of each afferent
    std::map<std::ptrdiff_t, std::size_t> rows;   // from an element of OneStep::row to its index
    for (std::uint32_t s = 0; s < pieces_.sites(); ++s) {
        const auto e = pieces_.at(tile / tiles_per_piece, s);
        for (std::size_t k = 0; k < e.count; ++k) {
            const std::size_t afferent = e.afferent[k] - e.origin - first;
            if (afferent >= tile_width) continue;  // of another tile
            entries.push_back({static_cast<std::ptrdiff_t>(s) - static_cast<std::ptrdiff_t>(afferent), afferent, e.weight[k]});
            rows[entries.back().row] = 0, ++counts[afferent];
        }
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
    const std::size_t sites = pieces_.sites();
    padded_force_.assign(sites + 2 * margin, 0);
    one_step_.resize(tiles_);
    WeightGroups groups;
    for (std::size_t t = 0; t < tiles_; ++t) build_tile(t, groups);
    has_rows_.assign(pieces_.pieces(), 1);
    for (std::size_t t = 0; t < tiles_; ++t)
        if (one_step_[t].row.empty()) has_rows_[t / tiles_per_piece] = 0;
    weights_ = lanes::AlignedBuffer<double>(groups.all.size());
    std::copy(groups.all.begin(), groups.all.end(), weights_.data());
    std::vector<std::uint32_t> last(tiles_, std::uint32_t(-1));  // for each tile the last site that was added to responding_tiles_
    responding_begin_.assign(1, 0);
    for (std::uint32_t s = 0; s < sites; ++s) {
        for (std::size_t p = 0; p < pieces_.pieces(); ++p) {
            const auto e = pieces_.at(p, s);
            for (std::size_t k = 0; k < e.count; ++k) {
                const std::size_t t = p * tiles_per_piece + (e.afferent[k] - e.origin) / tile_width;
                if (std::exchange(last[t], s) != s) responding_tiles_.push_back(static_cast<std::uint32_t>(t));
            }
        }
        responding_begin_.push_back(responding_tiles_.size());
    }
}

void FieldForce::compute_one_step(const Call& call) {
    if (one_step_.empty()) build_one_step();
    const bool all_touched = call.touched.size() == padded_force_.size() - 2 * margin;
    // Every afferent responds to a site, so no tile is without force if all sites are touched.
    std::fill(zero_force_.begin(), zero_force_.end(), static_cast<std::uint8_t>(!all_touched));
    if (!all_touched)
        for (const auto s : call.touched)
            for (std::size_t k = responding_begin_[s]; k < responding_begin_[s + 1]; ++k) zero_force_[responding_tiles_[k]] = 0;
    double* const force_at_site_0 = padded_force_.data() + margin;  // the padding is before it; all zero between calls
    const double* const force = call.force.data + call.at;
    if (all_touched && call.force.stride == 1)
        std::copy_n(force, call.touched.size(), force_at_site_0);
    else
        for (const auto s : call.touched) force_at_site_0[s] = force[s * call.force.stride];
    for (std::size_t piece = 0; piece < pieces_.pieces(); ++piece)
        has_rows_[piece] ? compute_rows(piece, force_at_site_0) : compute_site_by_site(piece, call);
    if (all_touched)
        std::fill_n(force_at_site_0, call.touched.size(), 0.0);
    else
        for (const auto s : call.touched) force_at_site_0[s] = 0;
}

/// Computes the force on a piece whose tiles all have rows.
void FieldForce::compute_rows(std::size_t piece, const double* force_at_site_0) {
    for (std::size_t t = piece * tiles_per_piece; t < std::min(tiles_, (piece + 1) * tiles_per_piece); ++t)
        if (const auto& tile = one_step_[t]; !zero_force_[t])
            lanes_.sum_rows(tile.row.data(), tile.row.size(), tile.weights.data(), weights_.data(), force_at_site_0,
                            rows_.data() + t * tile_width);
}

/// Computes the force on a piece that has tiles without rows: adds the contribution of each site to all afferents that respond to it.
void FieldForce::compute_site_by_site(std::size_t piece, const Call& call) {
    const std::size_t first = piece * tiles_per_piece, tiles = std::min(tiles_per_piece, tiles_ - first);
    double* const sums = rows_.data() + first * tile_width;
    bool any = false;
    for (std::size_t t = 0; t < tiles; ++t)
        if (!zero_force_[first + t]) std::fill_n(sums + t * tile_width, tile_width, 0.0), any = true;
    if (!any) return;
    for (const auto s : call.touched) {
        const double f = call.force.data[s * call.force.stride + call.at];
        const auto e = pieces_.at(piece, s);
        for (std::size_t k = 0; k < e.count; ++k) sums[e.afferent[k] - e.origin] += e.weight[k] * f;
    }
}

}  // namespace corpuscle
