#include "skin/field_pieces.hpp"

#include <algorithm>

#include "skin/field_force.hpp"

namespace corpuscle {
namespace {

/// Number of forces on `count` afferents, with padding to complete tiles if there are several receptors.
std::size_t force_count(const ReceptiveFields& fields, std::size_t count) {
    return fields.receptors == 1 ? count : (count + tile_width - 1) / tile_width * tile_width * fields.receptors;
}

}  // namespace

FieldPieces::FieldPieces(const ReceptiveFields& fields, std::size_t first, std::size_t count, std::size_t piece_forces)
    : forces_(force_count(fields, count)), piece_forces_(piece_forces), sites_(fields.begin.size() - 1), first_(first),
      afferent_(fields.afferent.data()), weight_(fields.weight.data()) {
    if (fields.receptors > 1) {
        sort_by_piece(fields, first, count);
        first_ = 0, afferent_ = sorted_.afferent.data(), weight_ = sorted_.weight.data();
    }
    find_pieces(fields.receptors > 1 ? sorted_.begin : fields.begin);
}

/// Copies the entries of these afferents to sorted_, with their numbers in ForceTiles, and for each site in the order of the pieces.
void FieldPieces::sort_by_piece(const ReceptiveFields& fields, std::size_t first, std::size_t count) {
    const std::size_t from = first * fields.receptors, to = (first + count) * fields.receptors;
    auto& [begin, afferents, weights, receptors] = sorted_;
    begin.reserve(sites_ + 1), begin.push_back(0);
    afferents.reserve(fields.afferent.size()), weights.reserve(fields.weight.size());
    for (std::size_t s = 0; s < sites_; ++s) {
        for (std::size_t k = fields.begin[s]; k < fields.begin[s + 1]; ++k) {
            const std::size_t number = fields.afferent[k];
            if (number < from || number >= to) continue;
            afferents.push_back(static_cast<std::uint32_t>(index_in_tiles(number - from, fields.receptors)));
            weights.push_back(fields.weight[k]);
            // The entries are almost in order already: only the receptors of 64 afferents alternate.
            for (auto at = afferents.size() - 1; at > begin[s] && afferents[at] / piece_forces_ < afferents[at - 1] / piece_forces_; --at)
                std::swap(afferents[at], afferents[at - 1]), std::swap(weights[at], weights[at - 1]);
        }
        begin.push_back(afferents.size());
    }
}

void FieldPieces::find_pieces(const std::vector<std::size_t>& begin) {
    begin_.resize((pieces() + 1) * sites_);
    for (std::size_t s = 0; s < sites_; ++s) {
        auto k = static_cast<std::uint32_t>(begin[s]);
        for (std::size_t piece = 0; piece <= pieces(); ++piece) {
            const std::size_t from = first_ + std::min(piece * piece_forces_, forces_);
            while (k < begin[s + 1] && afferent_[k] < from) ++k;
            begin_[piece * sites_ + s] = k;
        }
    }
}

}  // namespace corpuscle
