#pragma once
// The words of respond and run that are about netlists, as what is asked of them.

#include "circuit/knobs.hpp"
#include "verbs.hpp"

namespace corpuscle {

/// --supply, --temp, --corner, --mismatch.
std::vector<circuit::Knob> knobs_of(const NetlistWords&);

/// Every --trace, word by word.
std::vector<std::string> traces_of(const NetlistWords&);

/// The option among these that was said; "": none.
std::string said_of(const NetlistWords&);

}  // namespace corpuscle
