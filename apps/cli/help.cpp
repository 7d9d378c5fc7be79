#include "cli/help.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "cli/arguments/renamed_arguments.hpp"
#include "cli/output/terminal.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t max_width = 100;     // columns
constexpr std::size_t short_examples = 3;  // number of examples that --help of a verb prints

/// Breaks a line at blanks so that it fits max_width. Continuation lines begin with `indent` blanks; the lines before them end in `mark`.
std::string wrapped(std::string_view line, std::size_t indent, std::string_view mark = "") {
    const bool fits = columns_of(line) <= max_width;
    auto end = fits ? line.npos : line.rfind(' ', max_width - mark.size());
    if (!fits && (end == line.npos || end <= line.find_first_not_of(' '))) end = line.find(' ', max_width);
    if (end == line.npos) return std::string(line) + "\n";
    const auto part = line.substr(0, end);
    const auto first = fmt::format("{}{}\n", part.substr(0, part.find_last_not_of(' ') + 1), mark);
    const auto rest = line.substr(std::min(line.find_first_not_of(' ', end), line.size()));
    return rest.empty() ? first : first + wrapped(std::string(indent, ' ') + std::string(rest), indent, mark);
}

/// A name and its description, which begins in column `width`. After a long name the description begins on the next line.
std::string entry(const std::string& name, const std::string& description, std::size_t width) {
    const auto head = "  " + name;
    if (description.empty()) return wrapped(head, 4);
    if (columns_of(head) + 2 <= width) return wrapped(head + std::string(width - columns_of(head), ' ') + description, width);
    return wrapped(head, 4) + wrapped(std::string(width, ' ') + description, width);
}

/// A command in lines that end with a backslash, as a shell accepts them.
std::string continued(std::string_view command) { return wrapped(fmt::format("  {}", command), 6, " \\"); }

/// Formats a line of the footer with an example: a command, three or more blanks and its explanation. The explanation follows on a new line
/// if the command is long.
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

struct Footer {
    std::string examples, prose;
    bool omits_examples = false;  ///< true if there were more examples than the limit
};

/// Splits the footer into examples, one on each line, of which at most `limit` are kept, and all other paragraphs.
Footer split_footer(const std::string& footer, std::size_t limit) {
    Footer out;
    bool in_examples = false;
    std::size_t count = 0;
    for (const auto line : split(footer, '\n')) {
        const bool is_title = line == "Examples:" || line == "Example:" || line == "First steps:";
        in_examples = (in_examples || is_title) && !line.empty();
        if (in_examples && !is_title && ++count > limit) {
            out.omits_examples = true;
            continue;
        }
        // Indented lines are lists. Their continuation lines begin in column 17, as the titles of studies do.
        in_examples ? out.examples += example(line) : out.prose += wrapped(line, line.starts_with("  ") ? 17 : 0);
    }
    const auto text = out.prose.find_first_not_of('\n');
    out.prose.erase(0, std::min(text, out.prose.size()));
    return out;
}

/// True if argument k is `text`. For a text without blank, "--limit" or "transduction", the argument may have a value: "--limit=2N". For an
/// option with a value, "--stamp count", the arguments are "--stamp=count", or "--stamp" and "count".
bool is_at(const std::vector<std::string>& arguments, std::size_t k, std::string_view text) {
    const auto blank = text.find(' ');
    const auto name = text.substr(0, blank);
    const std::string_view argument = arguments[k];
    const bool is_joined =
        argument.starts_with("--") && argument.size() > name.size() && argument[name.size()] == '=' && argument.starts_with(name);
    if (blank == text.npos) return is_joined || argument == name;
    const auto value = text.substr(blank + 1);
    return is_joined ? argument.substr(name.size() + 1) == value
                     : argument == name && k + 1 < arguments.size() && arguments[k + 1] == value;
}

}  // namespace

std::string Help::make_option(const CLI::Option* option, bool is_positional) const {
    return entry(make_option_name(option, is_positional) + make_option_opts(option), make_option_desc(option), width_of_names);
}

std::string Help::make_subcommand(const CLI::App* verb) const {
    return entry(verb->get_display_name(true), verb->get_description(), width_of_names / 2);
}

std::span<const std::string> Help::common_options(const CLI::App& app) const {
    const auto found = std::find_if(verbs_.begin(), verbs_.end(), [&](const auto& verb) { return verb.name == app.get_name(); });
    return found == verbs_.end() ? std::span<const std::string>() : found->common_options;
}

std::string Help::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
    if (mode == CLI::AppFormatMode::Sub) return make_expanded(app);
    const bool has_more_options = !common_options(*app).empty();
    const bool is_short = mode == CLI::AppFormatMode::Normal && app->get_parent() != nullptr;
    const auto [examples, prose, omits_examples] = split_footer(app->get_footer(), is_short ? short_examples : std::string::npos);
    auto out = wrapped(app->get_description(), 0) + make_usage(app, name);
    if (!examples.empty()) out += "\n" + examples;
    out += make_positionals(app) + list_options(app, mode) + make_subcommands(app, CLI::AppFormatMode::Normal);
    if (!prose.empty()) out += "\n" + prose;
    if (is_short && (omits_examples || has_more_options))
        out += fmt::format("\nAll examples{}: {} --help-all\n", has_more_options ? " and options" : "", name);
    for (std::size_t at = 0; (at = out.find("\n\n\n", at)) != out.npos;) out.erase(at, 1);
    return out;
}

std::string Help::list_options(const CLI::App* app, CLI::AppFormatMode mode) const {
    const auto common = common_options(*app);
    if (mode != CLI::AppFormatMode::Normal || common.empty()) return make_groups(app, mode);
    return make_group("Options", false, app->get_options([&](const CLI::Option* option) {
        const auto name = option->get_name();
        return option->nonpositional() && (name == "--help-all" || std::find(common.begin(), common.end(), name) != common.end());
    }));
}

std::vector<std::string> normalize_help(std::vector<std::string> arguments) {
    if (arguments.empty()) return {"--help"};
    if (arguments[0] != "help") return arguments;
    arguments.erase(arguments.begin());
    arguments.emplace_back("--help");
    return arguments;
}

std::string unknown_option_error(const CLI::App& app, const std::vector<std::string>& arguments) {
    std::vector<std::string> known;
    const CLI::App* current = &app;
    std::string name;
    const auto add_options = [&] {
        for (const auto* option : current->get_options())
            for (const auto& n : option->get_lnames()) known.push_back("--" + n);
    };
    add_options();
    for (std::size_t k = 0; k < arguments.size() && arguments[k] != "--"; ++k) {  // follows the verbs: "sweep", "show"
        const auto verbs = current->get_subcommands([&](const CLI::App* verb) { return verb->get_name() == arguments[k]; });
        if (verbs.empty()) continue;
        current = verbs.front(), name += (name.empty() ? "" : " ") + arguments[k];
        add_options();
    }
    const std::vector<std::string_view> names(known.begin(), known.end());
    for (std::size_t k = 1; k < arguments.size() && arguments[k] != "--"; ++k) {
        for (const auto& r : renamed_arguments)
            if (r.verb == arguments[0] && is_at(arguments, k, r.old_text))
                return fmt::format("{}: {} is now {}", name, r.old_text, r.new_text);
        const std::string_view option = std::string_view(arguments[k]).substr(0, arguments[k].find('='));
        if (!option.starts_with("--") || std::find(names.begin(), names.end(), option) != names.end()) continue;
        const auto hint = did_you_mean(option, names);
        return fmt::format("{}: unknown option '{}'{}", name, option,
                           hint.empty() ? fmt::format("; 'corpuscle {} --help-all' lists the options", name) : hint);
    }
    return "";
}

std::string unknown_verb_error(const CLI::App& app, const std::vector<std::string>& arguments) {
    const auto all = [](const CLI::App*) { return true; };
    const auto has_positional = [](const CLI::App& verb) {
        return !verb.get_options([](const CLI::Option* o) { return o->get_positional(); }).empty();
    };
    const CLI::App* current = &app;
    std::string context;                  // "fit: " behind the verb fit
    for (const auto& word : arguments) {  // follows the verbs: "sweep", "show"
        const auto verbs = current->get_subcommands(all);
        if (verbs.empty() || word.empty() || word.starts_with('-') || has_positional(*current)) return "";
        const auto at = std::find_if(verbs.begin(), verbs.end(), [&](const CLI::App* verb) { return verb->get_name() == word; });
        if (at == verbs.end()) {
            std::vector<std::string> names;
            for (const auto* verb : verbs) names.push_back(verb->get_name());
            const auto hint = did_you_mean(word, std::vector<std::string_view>(names.begin(), names.end()));
            return fmt::format("{}unknown verb '{}'{}", context, word,
                               hint.empty() ? fmt::format("; the verbs are {}", joined(names)) : hint);
        }
        current = *at, context += word + ": ";
    }
    return "";
}

}  // namespace corpuscle
