#pragma once
// Finds the hierarchical name, such as "xsummer.mn3b", that a user means by a shorter text, such as "summer.N3B". Dots separate the pieces
// of a name.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace corpuscle::circuit {

/// The kind of object that the last piece of a name denotes. The x of a subcircuit and the first letter of an element may be left out.
enum class LastPiece { node, element };

/// Indices of the names that match `typed`, ignoring case. `names` must be in small letters. Pieces are compared from the end, and the last
/// pieces of a name are enough. A match of the full path is better than a match of its end, and after that exact spelling is better than
/// left-out letters. Only the best matches are returned; several indices mean that `typed` is ambiguous.
std::vector<std::size_t> find_matching_names(std::span<const std::string_view> names, std::string_view typed, LastPiece);

/// The last pieces of a name, as many as `pieces` says, without the letters that may be left out: "summer.n3b".
std::string short_name(std::string_view name, std::size_t pieces, LastPiece);

/// The number of pieces of a name.
std::size_t piece_count(std::string_view name);

/// A list for a message, of at most 6 names: "xa.m1, xb.m1, ... and 3 more".
std::string abbreviated_list(std::span<const std::string_view> names);

}  // namespace corpuscle::circuit
