#pragma once
// Replaces the directives in the text of a netlist.

#include <string>

namespace corpuscle {

/// The text with its analyses, measures and other directives blanked, and these lines appended. Line numbers are preserved.
std::string with_directives(const std::string& text, const std::string& directives);

}  // namespace corpuscle
