// corpuscle-study, which "corpuscle study" starts: reproduces published results and compares them with the published numbers.

#include <fmt/format.h>

#include "cli/arguments/option_rows.hpp"
#include "cli/arguments/report_page.hpp"
#include "cli/program.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/program/study_command.hpp"

namespace {

using namespace corpuscle;

std::string study_help() {
    std::string known;
    for (const auto* s : all_studies) known += fmt::format("\n  {:14} {}", s->name, s->title);
    std::string recorded;
    for (const auto* s : recorded_studies) recorded += fmt::format("\n  {:14} {}", s->name, s->title);
    return "Studies:" + known + "\n\nStudies of recordings, not part of 'all' (CORPUSCLE_DATA: directory of the recordings):" + recorded +
           "\n\nExamples:\n  corpuscle study all --report reproduction.html\n  corpuscle study fig24 table17 --report chips.html\n"
           "  corpuscle study fig3 --json";
}

class StudyVerb final : public Verb {
    StudyArguments args_;

public:
    StudyVerb() : Verb({"study", "reproduce published results and compare them with the published numbers", study_help()}) {}

    void add_options_to(CLI::App& part, CommonArguments& common) override {
        add_options(part, "",
                    {{"NAME", &args_.names, "", "the studies to run (default: all)"},
                     {"--report", &args_.report_file, "FILE.html", "write a report page: figures, published and computed numbers"},
                     {"--markdown", &args_.markdown_file, "FILE.md", "write all numbers as Markdown"}});
        add_common_options(part, common);
        add_overwrite_option(part, common);
    }

    Result<void> check_arguments(const CommonArguments&) override { return check_page_name(args_.report_file); }
    int run(const CommonArguments& common) override { return study(args_, common); }
};

}  // namespace

int main(int argc, char** argv) {
    VerbList verbs;
    verbs.push_back(std::make_unique<StudyVerb>());
    return run_program({"Corpuscle: the reproduction of the thesis."}, verbs, argc, argv);
}
