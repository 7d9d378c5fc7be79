#pragma once
// A verb of the program, such as "respond", and the arguments that all verbs have.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace CLI {
class App;
}

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
    std::vector<TypedOption> typed = {};  ///< the options that were given to the verb, in the order of --help-all
    std::vector<std::string> words = {};  ///< the words of the command line, beginning with the verb
};

/// The texts of a verb in --help.
struct VerbTexts {
    std::string name, description;                 ///< the description is one line
    std::string examples = {};                     ///< examples ("Examples:", then one per line) and paragraphs that explain them
    std::vector<std::string> common_options = {};  ///< the options that --help lists; empty: all, as --help-all
};

/// A verb: declares its options, and runs with the arguments that they set.
class Verb {
public:
    const VerbTexts texts;

    explicit Verb(VerbTexts t) : texts(std::move(t)) {}
    virtual ~Verb() = default;
    Verb(const Verb&) = delete;
    Verb& operator=(const Verb&) = delete;

    /// Adds the options of this verb to its part of the command line.
    virtual void add_options_to(CLI::App& part, CommonArguments&) = 0;
    /// Checks the parsed arguments, and completes those that depend on each other. An error is one of usage.
    virtual Result<void> check_arguments(const CommonArguments&) { return {}; }
    /// Runs the verb. Returns the exit status.
    virtual int run(const CommonArguments&) = 0;

    /// Verbs that may follow this one, such as show in "sweep show".
    virtual std::span<const std::unique_ptr<Verb>> sub_verbs() const { return {}; }
    /// True if run() starts another program, which reads CommonArguments::words; the verb then has no options here.
    virtual bool is_program() const { return false; }
};

using VerbList = std::vector<std::unique_ptr<Verb>>;

/// Adds the options --json and --quiet.
void add_common_options(CLI::App& part, CommonArguments&);
/// Adds --overwrite, for verbs that write complete files.
void add_overwrite_option(CLI::App& part, CommonArguments&);

}  // namespace corpuscle
