#pragma once
// Completion of a command line in a shell. The scripts in apps/cli/shell/scripts start `corpuscle __complete WORD...` with the words after
// the name of the program, of which the last one is being typed.

#include "cli/verb.hpp"

namespace corpuscle {

/// The words that may follow, one in a line. A word that ends with '=' or '.' is continued without a blank. The line ":files" means that
/// names of files may follow, too. `extra_options` are those of every verb, such as --help.
std::string completions(const std::vector<Verb>&, const std::vector<std::string>& words, const std::vector<std::string>& extra_options);

}  // namespace corpuscle
