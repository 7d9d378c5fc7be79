#pragma once
// The report page of studies: a table of all claims, then the figures of each study. One self-contained HTML file.

#include <span>
#include <string>

#include "study/study.hpp"

namespace corpuscle {

std::string study_page(std::span<const Study* const>, std::span<const StudyResult>, const std::string& command);

}  // namespace corpuscle
