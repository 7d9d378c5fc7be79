#include "circuit/variant/hierarchical_names.hpp"

#include <fmt/format.h>

#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

constexpr int no_match = 4;  // above all ranks of match_rank()

/// True if the piece's first letter may be left out.
bool has_optional_letter(std::string_view piece, bool is_last, LastPiece kind) {
    if (piece.size() < 2) return false;
    return is_last ? kind == LastPiece::element : piece[0] == 'x';
}

/// How well a name matches the typed pieces; a lower rank is better. 0: `typed` is the full path; 1: the full path with letters left out;
/// 2 and 3: the same for the end of the path.
int match_rank(std::string_view name, std::span<const std::string_view> typed, LastPiece kind) {
    const auto pieces = split(name, '.');
    if (typed.size() > pieces.size()) return no_match;
    bool exact = true;
    for (std::size_t k = 0; k < typed.size(); ++k) {
        const auto piece = pieces[pieces.size() - 1 - k], word = typed[typed.size() - 1 - k];
        if (piece == word) continue;
        if (!has_optional_letter(piece, k == 0, kind) || piece.substr(1) != word) return no_match;
        exact = false;
    }
    return (typed.size() == pieces.size() ? 0 : 2) + (exact ? 0 : 1);
}

}  // namespace

std::size_t piece_count(std::string_view name) { return static_cast<std::size_t>(std::count(name.begin(), name.end(), '.')) + 1; }

std::vector<std::size_t> find_matching_names(std::span<const std::string_view> names, std::string_view typed, LastPiece kind) {
    const auto lower_case = lower(typed);
    const auto words = split(lower_case, '.');
    std::vector<std::size_t> out;
    int best = no_match;
    for (std::size_t k = 0; k < names.size(); ++k) {
        const int rank = match_rank(names[k], words, kind);
        if (rank < best) best = rank, out.clear();
        if (rank == best && rank < no_match) out.push_back(k);
    }
    return out;
}

std::string short_name(std::string_view name, std::size_t pieces, LastPiece kind) {
    const auto all = split(name, '.');
    std::string out;
    for (std::size_t k = all.size() - std::min(pieces, all.size()); k < all.size(); ++k) {
        if (!out.empty()) out += '.';
        out += all[k].substr(has_optional_letter(all[k], k + 1 == all.size(), kind) ? 1 : 0);
    }
    return out;
}

std::string abbreviated_list(std::span<const std::string_view> names) {
    constexpr std::size_t max_shown = 6;
    const auto shown = names.first(std::min(names.size(), max_shown));
    const auto more = names.size() > max_shown ? fmt::format(" and {} more", names.size() - max_shown) : "";
    return fmt::format("{}{}", joined(shown), more);
}

}  // namespace corpuscle::circuit
