#include "help.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "signal/parameter.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t max_width = 100;  // columns

/// The width of a UTF-8 text in columns, one per character.
std::size_t columns_of(std::string_view text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

/// Breaks a line at blanks; continuation lines begin with `indent` blanks.
std::string wrapped(std::string_view line, std::size_t indent) {
    std::string out;
    while (columns_of(line) > max_width) {
        auto end = line.rfind(' ', max_width);
        const auto first = line.find_first_not_of(' ');
        if (end == line.npos || end <= first) end = line.find(' ', max_width);
        if (end == line.npos) break;
        auto part = line.substr(0, end);
        part = part.substr(0, part.find_last_not_of(' ') + 1);
        out += std::string(part) + "\n";
        line = line.substr(std::min(line.find_first_not_of(' ', end), line.size()));
        if (line.empty()) return out;
        const std::string rest = std::string(indent, ' ') + std::string(line);
        return out + wrapped(rest, indent);
    }
    return out + std::string(line) + "\n";
}

/// A name and its description in columns. After a long name the description begins on the next line.
std::string entry(const std::string& name, const std::string& description, std::size_t width) {
    const auto head = "  " + name;
    if (description.empty()) return wrapped(head, 4);
    if (columns_of(head) + 2 <= width) return wrapped(head + std::string(width - columns_of(head), ' ') + description, width);
    return wrapped(head, 4) + wrapped(std::string(width, ' ') + description, width);
}

/// A command broken into lines with backslashes, as a shell accepts it; never broken within quotes.
std::string continued(std::string_view command) {
    std::string out;
    constexpr std::size_t max_command = max_width - 2;  // leaves two columns for the backslash
    for (std::string indent = "  "; columns_of(command) + indent.size() > max_width; indent = "      ") {
        std::size_t end = command.npos;
        bool quoted = false;
        for (std::size_t k = 0; k < command.size() && k + indent.size() <= max_command; ++k) {
            quoted ^= command[k] == '\'' || command[k] == '"';
            if (command[k] == ' ' && !quoted) end = k;
        }
        if (end == command.npos) break;
        out += fmt::format("{}{} \\\n", indent, command.substr(0, end));
        command.remove_prefix(end + 1);
    }
    return fmt::format("{}{}{}\n", out, out.empty() ? "  " : "      ", command);
}

/// An example and its explanation, which follows on a new line if the example is long.
std::string example(std::string_view line) {
    constexpr std::string_view gap = "   ";
    const auto begin = line.find_first_not_of(' ');
    if (columns_of(line) <= max_width || begin == line.npos) return std::string(line) + "\n";
    const auto end = line.find(gap, begin);
    if (end == line.npos) return continued(line.substr(begin));
    const auto command = line.substr(begin, end - begin), explanation = line.substr(line.find_first_not_of(' ', end));
    if (2 + columns_of(command) + gap.size() + columns_of(explanation) <= max_width)
        return fmt::format("  {}{}{}\n", command, gap, explanation);
    return fmt::format("{}      {}\n", continued(command), explanation);
}

/// Splits the footer into the paragraphs of examples and all others.
std::pair<std::string, std::string> split_footer(const std::string& footer) {
    std::pair<std::string, std::string> out;
    bool in_examples = false;
    for (std::size_t at = 0; at < footer.size();) {
        const auto end = std::min(footer.find('\n', at), footer.size());
        const std::string_view line(footer.data() + at, end - at);
        at = end + 1;
        for (const std::string_view title : {"Examples:", "Example:", "First steps:"}) in_examples = in_examples || line == title;
        in_examples = in_examples && !line.empty();
        in_examples ? out.first += example(line) : out.second += wrapped(line, line.starts_with("  ") ? 17 : 0);
    }
    const auto text = out.second.find_first_not_of('\n');
    out.second.erase(0, std::min(text, out.second.size()));
    return out;
}

}  // namespace

std::string Help::make_option(const CLI::Option* option, bool is_positional) const {
    return entry(make_option_name(option, is_positional) + make_option_opts(option), make_option_desc(option), width_of_names);
}

std::string Help::make_subcommand(const CLI::App* verb) const {
    return entry(verb->get_display_name(true), verb->get_description(), width_of_names / 2);
}

std::string Help::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
    if (mode == CLI::AppFormatMode::Sub) return make_expanded(app);
    const auto [examples, prose] = split_footer(app->get_footer());
    auto out = wrapped(app->get_description(), 0) + make_usage(app, std::move(name));
    if (!examples.empty()) out += "\n" + examples;
    out += make_positionals(app) + make_groups(app, mode) + make_subcommands(app, mode);
    if (!prose.empty()) out += "\n" + prose;
    for (std::size_t at = 0; (at = out.find("\n\n\n", at)) != out.npos;) out.erase(at, 1);
    return out;
}

std::vector<std::string> normalize_help(std::vector<std::string> arguments) {
    if (arguments.empty()) return {"--help"};
    if (arguments[0] != "help") return arguments;
    arguments.erase(arguments.begin());
    arguments.emplace_back("--help");
    return arguments;
}

std::string unknown_verb_error(const CLI::App& app, const std::vector<std::string>& arguments) {
    if (arguments.empty() || arguments[0].empty() || arguments[0].starts_with('-')) return "";
    std::vector<std::string> names;
    for (const auto* verb : app.get_subcommands([](const CLI::App*) { return true; })) names.push_back(verb->get_name());
    if (std::find(names.begin(), names.end(), arguments[0]) != names.end()) return "";
    const std::vector<std::string_view> known(names.begin(), names.end());
    const auto hint = did_you_mean(arguments[0], known);
    return fmt::format("unknown verb '{}'{}", arguments[0],
                       hint.empty() ? fmt::format("; the verbs are {}", fmt::join(names, ", ")) : hint);
}

}  // namespace corpuscle
