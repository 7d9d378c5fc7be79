#pragma once
// What --help prints: examples first, nothing wider than 100 columns.

#include <CLI/CLI.hpp>

namespace corpuscle {

class Help final : public CLI::Formatter {
public:
    Help() { column_width(width_of_names); }
    std::string make_help(const CLI::App*, std::string name, CLI::AppFormatMode) const override;
    std::string make_option(const CLI::Option*, bool is_positional) const override;
    std::string make_subcommand(const CLI::App*) const override;

private:
    static constexpr std::size_t width_of_names = 30;
};

/// "help respond" is "respond --help"; no words are "--help".
std::vector<std::string> with_help_first(std::vector<std::string> words);

/// The error of a first word that is no verb of the program, or "".
std::string unknown_verb(const CLI::App&, const std::vector<std::string>& words);

}  // namespace corpuscle
