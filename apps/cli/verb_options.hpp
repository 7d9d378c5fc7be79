#pragma once
// All options of a verb: its own, and those that verbs have in common.

#include "cli/verb.hpp"

namespace corpuscle {

/// In the order of --help-all. The options in common set `common`, which must outlive them.
std::vector<OptionGroup> all_options(const Verb&, CommonArguments& common);

}  // namespace corpuscle
