#pragma once
// A verb of the program, such as "respond", the arguments that all verbs have, and the function that runs a command line. The program of
// the reproduction uses it, too.

#include "cli/arguments/option_rows.hpp"

namespace corpuscle {

/// An option or positional argument as typed. `name` is the long name of an option: "--afferent".
struct TypedOption {
    std::string name;
    std::vector<std::string> values;
};

struct CommonArguments {
    bool json = false;                    ///< print one JSON document on standard output
    bool quiet = false;                   ///< print neither tables nor progress nor notes
    bool overwrite = false;               ///< also replace files that were not written by an earlier run
    std::string command;                  ///< the command line, see quote_command(); for the report page
    std::string complete_command = {};    ///< with the directories of files, so that it can be typed again
    std::vector<TypedOption> typed = {};  ///< the options that were given to the verb, in the order of --help-all
    std::vector<std::string> words = {};  ///< the words of the command line, beginning with the verb
};

/// A verb: its texts and options, and the function that runs it with the arguments that the options have set.
struct Verb {
    std::string name, description;                 ///< the description is one line
    std::string examples = {};                     ///< for --help: examples ("Examples:", then one per line), and explanations
    std::vector<std::string> common_options = {};  ///< the options that --help lists; empty: all, as --help-all
    std::vector<OptionGroup> options = {};         ///< without those that follow
    bool reports = false;                          ///< has the options --json and --quiet
    bool writes_files = false;                     ///< has the option --overwrite
    /// Checks the arguments, and completes those that depend on each other. An error is one of usage.
    std::function<Result<void>(const CommonArguments&)> check = [](const CommonArguments&) { return Result<void>(); };
    std::function<int(const CommonArguments&)> run;  ///< returns the exit status
    std::vector<Verb> sub_verbs = {};                ///< may follow this verb: show in "sweep show"
    bool is_program = false;                         ///< run() starts another program, which reads CommonArguments::words
};

/// Parses the command line and runs its verb. `about`, `first_steps`: texts of --help, the latter with examples. Prints help and errors.
/// Returns the exit status. A program with only one verb may be started without its name.
int run_program(const std::string& about, const std::string& first_steps, const std::vector<Verb>& verbs, int argc,
                const char* const* argv);

}  // namespace corpuscle
