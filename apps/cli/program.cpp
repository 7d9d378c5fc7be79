#include "cli/program.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <sstream>
#include <system_error>

#include "cli/help.hpp"
#include "cli/output/terminal.hpp"
#include "core/version.hpp"

namespace corpuscle {
namespace {

/// The options and positional arguments that were given to the verb.
std::vector<TypedOption> typed_options(const CLI::App& app) {
    std::vector<TypedOption> out;
    for (const auto* verb : app.get_subcommands())
        for (const auto* option : verb->get_options())
            if (option->count() > 0) out.push_back({option->get_name(), option->results()});
    return out;
}

}  // namespace

std::unique_ptr<CLI::App> make_command_line(const std::string& description) {
    auto app = std::make_unique<CLI::App>(description, "corpuscle");
    app->formatter(std::make_shared<Help>());
    app->set_help_flag("--help,-h", "print help");
    app->set_help_all_flag("--help-all", "print help with all examples and options");
    app->set_version_flag("--version", fmt::format("corpuscle {}", version));
    app->require_subcommand(1);
    return app;
}

void add_common(CLI::App& verb, CommonArguments& common) {
    verb.set_version_flag("--version", fmt::format("corpuscle {}", version))->group("");
    verb.add_flag("--json", common.json, "print one JSON document on standard output, and nothing else");
    verb.add_flag("--quiet,-q", common.quiet, "do not print tables, progress and notes; warnings are still printed");
}

void add_overwrite(CLI::App& verb, CommonArguments& common) {
    verb.add_flag("--overwrite", common.overwrite,
                  "also replace files that were not written by an earlier run; input files are never replaced");
}

int run_command_line(CLI::App& app, std::vector<std::string> arguments, CommonArguments& common, const std::function<int()>& run_verb) {
    std::signal(SIGXFSZ, SIG_IGN);  // exceeding the file size limit is a write error
    int status = 0;
    try {
        if (const auto error = unknown_verb_error(app, arguments); !error.empty()) return report_error(bad_usage(error));
        if (const auto error = unknown_option_error(app, arguments); !error.empty()) return report_error(bad_usage(error));
        std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them in reverse order
        app.parse(std::move(arguments));
        common.typed = typed_options(app);
        status = run_verb();
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() != 0) {
            print_message(e.what());
            print_message("'corpuscle help VERB' prints the most common options, 'corpuscle VERB --help-all' all of them");
            return 2;
        }
        std::ostringstream text;
        app.exit(e, text, text);
        std::fwrite(text.str().data(), 1, text.str().size(), stdout);
    } catch (const std::system_error&) {  // standard output failed: a closed pipe, a full disk
        if (interrupted()) return report_error({ErrorCode::interrupted, "interrupted"});
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
