#pragma once
// Runs a command line. Shared by the program and by the reproduction of the thesis, which is a program of its own.

#include "cli/verb.hpp"

namespace corpuscle {

/// The texts of --help of a program.
struct ProgramTexts {
    std::string about;
    std::string first_steps = {};  ///< examples
};

/// Parses the command line and runs its verb. Prints help and errors. Returns the exit status. A program with only one verb may be started
/// without its name.
int run_program(const ProgramTexts&, const std::vector<Verb>& verbs, int argc, const char* const* argv);

}  // namespace corpuscle
