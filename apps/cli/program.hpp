#pragma once
// Runs a command line. Shared by the program and by the reproduction of the thesis, which is a program of its own.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cli/verbs.hpp"

namespace CLI {
class App;
}

namespace corpuscle {

/// The root of a command line: name, description, --help, --help-all and --version. Verbs are added to it.
std::unique_ptr<CLI::App> make_command_line(const std::string& description);

/// Adds the options that every verb has: --json, --quiet.
void add_common(CLI::App& verb, CommonArguments&);
/// Adds --overwrite, for verbs that write complete files.
void add_overwrite(CLI::App& verb, CommonArguments&);

/// Parses the arguments, which begin with the verb, and calls `run_verb`. Prints help and errors. Returns the exit status.
int run_command_line(CLI::App&, std::vector<std::string> arguments, CommonArguments&, const std::function<int()>& run_verb);

}  // namespace corpuscle
