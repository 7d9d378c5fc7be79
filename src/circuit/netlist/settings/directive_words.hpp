#pragma once
// Directives: their words, in which expressions are in braces or quotes, and the overrides that concern them.

#include <string>

#include "circuit/netlist/scope.hpp"

namespace corpuscle::circuit {

/// The part of a word from offset `from` on, without surrounding braces or quotes.
WordRef without_braces(const Statement&, Word, std::uint32_t from);
/// The word without blanks outside quotes and braces. Expressions that depend only on parameters are replaced by their values.
std::string without_blanks(const Scope&, const Statement&, const Word&);

/// The directive of a line of the top level, whose scope is `top`.
Directive make_directive(const Scope& top, const Statement&);
/// Applies the overrides that concern directives. .expect holds only for the netlist as written: if `changes_values`, it is
/// removed with a warning.
void apply_directive_overrides(const ResolvedOverrides&, bool changes_values, Circuit&);

}  // namespace corpuscle::circuit
