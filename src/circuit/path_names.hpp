#pragma once
// Names with paths, "xsummer.mn3b", found by what people type of them: "summer.N3B".

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace corpuscle::circuit {

/// Of which pieces the first letter, which is SPICE's, may be left out: x of subcircuits, and the last piece's own.
enum class Last { node, element };

/// The places in `names` of those that are meant by what is typed: in letters of either case, piece by piece from the end, which may be
/// enough. A whole name goes before a tail, a name in full before one without its letters: only the best of these are given.
std::vector<std::size_t> meant(std::span<const std::string_view> names, std::string_view typed, Last);

/// The name without what may be left out, and no more than its last pieces: "summer.n3b".
std::string short_name(std::string_view name, std::size_t pieces, Last);

/// How many pieces it has.
std::size_t pieces_in(std::string_view name);

/// "xa.m1, xb.m1 and 3 more": some of them, for a sentence.
std::string some_of(std::span<const std::string_view> names);

}  // namespace corpuscle::circuit
