#pragma once
// Studies as a page to look at: a table of all claims on top, then each study's figures. One HTML file, no network.

#include <span>
#include <string>

#include "study/study.hpp"

namespace corpuscle {

std::string study_page(std::span<const Study* const>, std::span<const Outcome>, const std::string& command);

}  // namespace corpuscle
