#pragma once
// The report page of studies: the headline claims of all studies, then the claims and figures of each study. One self-contained HTML file.

#include <span>
#include <string>

#include "reproduction/claims/study.hpp"

namespace corpuscle {

/// The page as HTML. There must be one outcome for each study, in the same order. `command`: the command line.
std::string study_page(std::span<const Study* const> studies, std::span<const StudyResult> outcomes, const std::string& command);

}  // namespace corpuscle
