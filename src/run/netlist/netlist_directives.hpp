#pragma once
// Replaces the directives in the text of a netlist.

#include <string>

namespace corpuscle {

/// The text of a netlist, in which the lines of analyses, measures, outputs and expectations are blanked, so that line numbers are
/// preserved. The lines `directives` and .end are appended.
std::string with_directives(const std::string& text, const std::string& directives);

}  // namespace corpuscle
