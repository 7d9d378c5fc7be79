#pragma once
// Formats --help: examples first, lines of at most 100 columns. --help of a verb prints few examples, and for verbs with many options only
// the common options; --help-all prints everything.

#include <CLI/CLI.hpp>

#include "cli/verb.hpp"

namespace corpuscle {

class Help final : public CLI::Formatter {
public:
    /// `verbs` outlive this object.
    explicit Help(const std::vector<Verb>& verbs) : verbs_(verbs) { column_width(width_of_names); }
    std::string make_help(const CLI::App*, std::string name, CLI::AppFormatMode) const override;
    std::string make_option(const CLI::Option*, bool is_positional) const override;
    std::string make_subcommand(const CLI::App*) const override;

private:
    const std::vector<Verb>& verbs_;

    /// The options that --help of this verb lists; empty: all.
    std::span<const std::string> common_options(const CLI::App&) const;
    /// The text of the options: all groups for --help-all and for verbs with few options, otherwise the common options.
    std::string list_options(const CLI::App*, CLI::AppFormatMode) const;
    static constexpr std::size_t width_of_names = 30;  // columns, before the descriptions of options
};

/// Rewrites "help respond" to "respond --help", and an empty command line to "--help".
std::vector<std::string> normalize_help(std::vector<std::string> arguments);

/// The error message if an argument is a former spelling (renamed_arguments.hpp) or an option that the verb does not have, else "".
std::string unknown_option_error(const CLI::App&, const std::vector<std::string>& arguments);

/// The error message if the first argument is not a verb of the program, else "".
std::string unknown_verb_error(const CLI::App&, const std::vector<std::string>& arguments);

}  // namespace corpuscle
