// corpuscle-study, which "corpuscle study" starts: reproduces published results and compares them with the published numbers.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "cli/arguments/option_groups.hpp"
#include "cli/help.hpp"
#include "cli/output/terminal.hpp"
#include "cli/program.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/program/study_command.hpp"

namespace {

using namespace corpuscle;

void add_study(CLI::App& app, StudyArguments& args, CommonArguments& common) {
    auto& verb = *app.add_subcommand("study", "reproduce published results and compare them with the published numbers");
    std::string known;
    for (const auto* s : all_studies) known += fmt::format("\n  {:14} {}", s->name, s->title);
    std::string recorded;
    for (const auto* s : recorded_studies) recorded += fmt::format("\n  {:14} {}", s->name, s->title);
    verb.footer("Studies:" + known +
                "\n\nStudies of recordings, not part of 'all' (CORPUSCLE_DATA: directory of the recordings):" + recorded +
                "\n\nExamples:\n  corpuscle study all --report reproduction.html\n  corpuscle study fig24 table17 --report chips.html\n"
                "  corpuscle study fig3 --json");
    verb.add_option("NAME", args.names, "the studies to run (default: all)");
    verb.add_option("--report", args.report_file, "write a report page: figures, published and computed numbers")->type_name("FILE.html");
    verb.callback([&args] {
        if (!args.report_file.empty() && !args.report_file.ends_with(".html"))
            throw CLI::ValidationError(page_name_error(args.report_file));
    });
    verb.add_option("--markdown", args.markdown_file, "write all numbers as Markdown")->type_name("FILE.md");
    add_common(verb, common);
    add_overwrite(verb, common);
}

}  // namespace

int main(int argc, char** argv) {
    CommonArguments common;
    common.command = quote_command(argc, argv);
    auto arguments = normalize_help({argv + 1, argv + argc});
    if (arguments[0] != "study") arguments.insert(arguments.begin(), "study");  // started by its own name
    StudyArguments study_arguments;
    const auto app = make_command_line("Corpuscle: the reproduction of the thesis.");
    add_study(*app, study_arguments, common);
    return run_command_line(*app, std::move(arguments), common, [&] { return study(study_arguments, common); });
}
