#pragma once
// The work of corpuscle study: runs studies and prints or writes their claims.

#include <string>
#include <vector>

#include "cli/verb.hpp"

namespace corpuscle {

struct StudyArguments {
    std::vector<std::string> names;
    std::string report_file, markdown_file;
};

/// Returns the exit status.
int study(const StudyArguments&, const CommonArguments&);

}  // namespace corpuscle
