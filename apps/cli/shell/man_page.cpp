#include "cli/shell/man_page.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "core/text/ascii_text.hpp"
#include "core/version.hpp"

namespace corpuscle {
namespace {

/// A text as roff prints it, also at the beginning of a line.
std::string escaped(std::string_view text) {
    std::string out = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
    for (const char c : text) {
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else if (c == '\'')
            out += "\\(aq";
        else
            out += c;
    }
    return out;
}

std::string section(std::string_view title, const std::string& text) { return text.empty() ? "" : fmt::format(".SH {}\n{}", title, text); }

/// "corpuscle sweep show", or with '-' the name of its page.
std::string path_of(const CLI::App& app, char separator) {
    const auto* const parent = app.get_parent();
    return parent ? path_of(*parent, separator) + separator + app.get_name() : app.get_name();
}

/// An option or positional argument: its names in bold, its value, and its description.
std::string option_text(const Help& help, const CLI::Option& option) {
    const bool is_positional = option.get_positional();
    const auto value = help.make_option_opts(&option);
    return fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", escaped(option.get_name(is_positional, !is_positional)), escaped(value),
                       escaped(option.get_description()));
}

/// The options of a group; positional arguments are a group of their own.
std::string options_text(const Help& help, const CLI::App& app, const std::string& group, bool is_positional) {
    std::string out;
    for (const auto* option : app.get_options())
        if (option->get_positional() == is_positional && (is_positional || option->get_group() == group)) out += option_text(help, *option);
    return out;
}

std::string all_options_text(const Help& help, const CLI::App& app) {
    std::string out;
    for (const auto& group : app.get_groups()) {
        const auto options = group.empty() ? "" : options_text(help, app, group, false);
        if (options.empty()) continue;
        out += group == "Options" ? options : fmt::format(".SS {}\n{}", escaped(group), options);
    }
    return out;
}

/// Examples and explanations of the footer. Indented lines are printed as they are.
std::string footer_text(const std::string& footer) {
    std::string out;
    bool is_literal = false, begins_paragraph = false;
    for (const auto line : split(footer, '\n')) {
        if (line.empty()) {
            begins_paragraph = !out.empty();
            continue;
        }
        const bool indented = line.starts_with("  ");
        if (is_literal && !indented) out += ".fi\n";
        if (begins_paragraph || indented != is_literal) out += out.empty() ? "" : ".PP\n";
        if (indented && !is_literal) out += ".nf\n";
        out += escaped(line) + "\n";
        is_literal = indented, begins_paragraph = false;
    }
    return is_literal ? out + ".fi\n" : out;
}

std::string verbs_text(const CLI::App& app) {
    std::string out;
    for (const auto* verb : app.get_subcommands([](const CLI::App*) { return true; }))
        out += fmt::format(".TP\n\\fB{}\\fR(1)\n{}\n", escaped(path_of(*verb, '-')), escaped(verb->get_description()));
    return out;
}

std::string synopsis_text(const CLI::App& app) {
    auto out = fmt::format(".B {}\n[\\fIoptions\\fR]", escaped(path_of(app, ' ')));
    for (const auto* option : app.get_options())
        if (option->get_positional())
            out += fmt::format("{}\\fI{}\\fR{}", option->get_required() ? " " : " [", escaped(option->get_name(true, false)),
                               option->get_required() ? "" : "]");
    const bool has_verbs = !app.get_subcommands([](const CLI::App*) { return true; }).empty();
    return out + (has_verbs ? " [\\fIverb\\fR ...]\n" : "\n");
}

std::string page_text(const Help& help, const CLI::App& app) {
    const auto name = path_of(app, '-');
    const auto* const parent = app.get_parent();
    return fmt::format(".TH {} 1 \"\" \"corpuscle {}\" \"User Commands\"\n", name, version) +
           section("NAME", fmt::format("{} \\- {}\n", escaped(name), escaped(app.get_description()))) +
           section("SYNOPSIS", synopsis_text(app)) + section("ARGUMENTS", options_text(help, app, "", true)) +
           section("OPTIONS", all_options_text(help, app)) + section("VERBS", verbs_text(app)) +
           section("NOTES", footer_text(app.get_footer())) +
           section("SEE ALSO", fmt::format("\\fB{}\\fR(1)\n", escaped(parent ? path_of(*parent, '-') : "corpuscle-respond")));
}

void add_pages(std::vector<ManPage>& to, const Help& help, const CLI::App& app, const std::vector<Verb>& verbs) {
    for (const auto& verb : verbs) {
        if (verb.is_program) continue;
        const auto& part = *app.get_subcommand(verb.name);
        to.push_back({path_of(part, '-') + ".1", page_text(help, part)});
        add_pages(to, help, part, verb.sub_verbs);
    }
}

}  // namespace

std::vector<ManPage> man_pages(const CLI::App& app, const std::vector<Verb>& verbs) {
    const Help help(verbs);
    std::vector<ManPage> out;
    if (verbs.size() > 1) out.push_back({app.get_name() + ".1", page_text(help, app)});
    add_pages(out, help, app, verbs);
    return out;
}

}  // namespace corpuscle
