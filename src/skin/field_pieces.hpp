#pragma once
// The receptive fields of a class in pieces of some tiles of afferents, each of which one thread computes.

#include "skin/innervation.hpp"

namespace corpuscle {

/// Entries of ReceptiveFields that follow each other, all of one site and one piece.
struct FieldEntries {
    const std::uint32_t* afferent;  ///< minus `origin`: number of the force, counted from the first one of the piece
    const double* weight;
    std::size_t count;
    std::uint32_t origin;
};

/// Finds the entries of a site in a piece. Afferents with several receptors have a force for each, in the order of ForceTiles, for which
/// their entries are copied. The entries of all others are those of the ReceptiveFields, which must outlive this object.
class FieldPieces {
public:
    /// For the afferents [first, first + count) of a class; a piece has `piece_forces` forces, a multiple of tile_width.
    FieldPieces(const ReceptiveFields&, std::size_t first, std::size_t count, std::size_t piece_forces);

    std::size_t forces() const { return forces_; }  ///< on all afferents, with padding to complete tiles if there are several receptors
    std::size_t pieces() const { return (forces_ + piece_forces_ - 1) / piece_forces_; }
    std::size_t sites() const { return sites_; }
    FieldEntries at(std::size_t piece, std::size_t site) const {
        const std::size_t begin = begin_[piece * sites_ + site], end = begin_[(piece + 1) * sites_ + site];
        return {afferent_ + begin, weight_ + begin, end - begin, static_cast<std::uint32_t>(first_ + piece * piece_forces_)};
    }

private:
    std::size_t forces_, piece_forces_, sites_;
    std::size_t first_;                 // number in afferent_ of the first force of the first piece
    ReceptiveFields sorted_;            // a copy with the numbers of ForceTiles; empty: not needed
    const std::uint32_t* afferent_;     // those of `sorted_` or of the given fields
    const double* weight_;              // the same
    std::vector<std::uint32_t> begin_;  // [piece][site]: the first entry of this piece or a later one, and a last row with the ends

    void sort_by_piece(const ReceptiveFields&, std::size_t first, std::size_t count);
    void find_pieces(const std::vector<std::size_t>& begin);
};

}  // namespace corpuscle
