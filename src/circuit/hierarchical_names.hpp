#pragma once
// Finds hierarchical names, such as "xsummer.mn3b", from the text that a user types, such as "summer.N3B". Dots separate the pieces of a
// name.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace corpuscle::circuit {

/// The kind of object that the last piece of a name denotes. The x of a subcircuit and the first letter of an element may be left out.
enum class LastPiece { node, element };

/// Indices of the names that match `typed`. Letters of either case match. Pieces are compared from the end, and the last pieces are
/// enough. A match of the full path wins over a match of its end, and exact spelling wins over left-out letters; only the best kind of
/// match is returned.
std::vector<std::size_t> find_matching_names(std::span<const std::string_view> names, std::string_view typed, LastPiece);

/// The last pieces of a name, without the letters that may be left out: "summer.n3b".
std::string short_name(std::string_view name, std::size_t pieces, LastPiece);

/// The number of pieces of a name.
std::size_t piece_count(std::string_view name);

/// A list for a message: "xa.m1, xb.m1 and 3 more".
std::string abbreviated_list(std::span<const std::string_view> names);

}  // namespace corpuscle::circuit
