// Parses a command line, prints help and errors, and runs the verb.

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <sstream>
#include <system_error>

#include "cli/help.hpp"
#include "cli/output/output_files.hpp"
#include "cli/output/terminal.hpp"
#include "cli/shell/completion.hpp"
#include "cli/shell/man_page.hpp"
#include "cli/verb_options.hpp"
#include "core/version.hpp"

namespace corpuscle {
namespace {

/// Adds the part of each verb, and of the verbs that may follow it, to the command line.
void add_verbs(CLI::App& app, const std::vector<Verb>& verbs, CommonArguments& common) {
    for (const auto& verb : verbs) {
        auto& part = *app.add_subcommand(verb.name, verb.description);
        part.footer(verb.examples);
        if (verb.is_program) continue;
        part.set_version_flag("--version", fmt::format("corpuscle {}", version))->group("");
        for (const auto& group : all_options(verb, common)) add_options(part, group);
        if (!verb.sub_verbs.empty()) part.require_subcommand(0, 1);
        add_verbs(part, verb.sub_verbs, common);
    }
}

/// The root of a command line: name, description, --help, --help-all and --version, and the verbs.
std::unique_ptr<CLI::App> make_command_line(const std::string& about, const std::vector<Verb>& verbs, CommonArguments& common) {
    auto app = std::make_unique<CLI::App>(about, "corpuscle");
    app->formatter(std::make_shared<Help>(verbs));
    app->set_help_flag("--help,-h", "print help");
    app->set_help_all_flag("--help-all", "print help with all examples and options");
    app->set_version_flag("--version", fmt::format("corpuscle {}", version));
    app->require_subcommand(1);
    add_verbs(*app, verbs, common);
    return app;
}

/// The verb that the parsed command line names: the last one of "sweep show".
const Verb* named_verb(const CLI::App& app, const std::vector<Verb>& verbs) {
    for (const auto& verb : verbs) {
        if (!app.got_subcommand(verb.name)) continue;
        const auto* const sub_verb = named_verb(*app.get_subcommand(verb.name), verb.sub_verbs);
        return sub_verb ? sub_verb : &verb;
    }
    return nullptr;
}

/// The options and positional arguments that were given to the verb.
std::vector<TypedOption> typed_options(const CLI::App& app) {
    std::vector<TypedOption> out;
    for (const auto* verb : app.get_subcommands())
        for (const auto* option : verb->get_options())
            if (option->count() > 0) out.push_back({option->get_name(), option->results()});
    return out;
}

int report_usage_error(const std::string& message) {
    print_message(message);
    print_message("'corpuscle help VERB' prints the most common options, 'corpuscle VERB --help-all' all of them");
    return static_cast<int>(ErrorCode::bad_usage);
}

/// Parses the words of the command line and runs the verb. Returns its exit status; exceptions are those of CLI11 and of standard output.
int run_command_line(CLI::App& app, const std::vector<Verb>& verbs, CommonArguments& common) {
    for (const auto& error : {unknown_verb_error(app, common.words), unknown_option_error(app, common.words)})
        if (!error.empty()) return report_error(bad_usage(error));
    app.parse(std::vector<std::string>(common.words.rbegin(), common.words.rend()));  // CLI11 takes them in reverse order
    common.typed = typed_options(app);
    const auto& verb = *named_verb(app, verbs);
    if (const auto ok = verb.check(common); !ok) return report_usage_error(ok.error().message);
    return verb.run(common);
}

/// Prints the words that may follow those behind __complete.
int print_completions(const std::vector<Verb>& verbs, const CommonArguments& common) {
    std::vector<std::string> words(common.words.begin() + 1, common.words.end());
    if (verbs.size() == 1 && !words.empty() && words[0] != verbs[0].name) words.insert(words.begin(), verbs[0].name);
    const auto text = completions(verbs, words, {"--help", "--help-all", "--version"});
    std::fwrite(text.data(), 1, text.size(), stdout);
    return 0;
}

/// Writes the manual pages into the directory behind __man.
Result<void> write_man_pages(const std::string& about, const std::string& first_steps, const std::vector<Verb>& verbs,
                             CommonArguments& common) {
    if (common.words.size() != 2) return bad_usage("__man: the directory for the manual pages is required");
    const auto app = make_command_line(about, verbs, common);
    app->footer(first_steps);
    for (const auto& page : man_pages(*app, verbs)) TRY(write_file(common.words[1] + "/" + page.name, page.text));
    return {};
}

}  // namespace

int run_program(const std::string& about, const std::string& first_steps, const std::vector<Verb>& verbs, int argc,
                const char* const* argv) {
    std::signal(SIGXFSZ, SIG_IGN);  // exceeding the file size limit is a write error
    CommonArguments common;
    std::vector<std::string> typed(argv + 1, argv + argc);
    if (verbs.size() == 1 && !typed.empty() && typed[0] != verbs[0].name)
        typed.insert(typed.begin(), verbs[0].name);  // corpuscle-study fig4
    common.command = quote_command(typed, false), common.complete_command = quote_command(typed, true);
    common.words = normalize_help({argv + 1, argv + argc});
    if (common.words[0] == "__man") return exit_status(write_man_pages(about, first_steps, verbs, common));
    for (const auto& verb : verbs)  // completed by the other program
        if (verb.is_program && common.words.size() > 2 && common.words[0] == "__complete" && common.words[1] == verb.name)
            return verb.run(common);
    if (common.words[0] == "__complete") return print_completions(verbs, common);
    if (verbs.size() == 1 && common.words[0] != verbs[0].name) common.words.insert(common.words.begin(), verbs[0].name);
    for (const auto& verb : verbs)
        if (verb.is_program && common.words[0] == verb.name) return verb.run(common);
    const auto app = make_command_line(about, verbs, common);
    app->footer(first_steps);
    int status = 0;
    try {
        status = run_command_line(*app, verbs, common);
    } catch (const OptionError& e) {
        return report_error(e.error);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() != 0) return report_usage_error(e.what());
        std::ostringstream text;
        app->exit(e, text, text);
        std::fwrite(text.str().data(), 1, text.str().size(), stdout);
    } catch (const std::system_error&) {  // standard output failed: a closed pipe, a full disk
        if (interrupted()) return report_error(interrupted_error());
        const auto done = finish_output();
        return report_error(done ? bad_input("cannot write all of standard output") : done.error());
    } catch (const std::bad_alloc&) {
        return report_error(bad_input("not enough memory; use fewer afferents, sites or samples at a time"));
    } catch (const std::exception& e) {
        return report_error(bad_input(e.what()));
    }
    const auto done = finish_output();
    return status == 0 && !done ? report_error(done.error()) : status;
}

}  // namespace corpuscle
