#pragma once
// corpuscle study: starts corpuscle-study, the program of the reproduction (reproduction/program).

#include <string>
#include <vector>

namespace corpuscle {

/// Replaces this process by corpuscle-study with the arguments, which begin with "study". Returns the exit status if this fails.
int start_study_program(const std::vector<std::string>& arguments);

}  // namespace corpuscle
