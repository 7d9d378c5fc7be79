// corpuscle-study, which "corpuscle study" starts: reproduces published results and compares them with the published numbers.

#include <fmt/format.h>

#include "cli/output/output_files.hpp"
#include "cli/verb.hpp"
#include "report/page_file.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/program/study_command.hpp"

namespace {

using namespace corpuscle;

std::string study_help() {
    std::string known;
    for (const auto* s : all_studies()) known += fmt::format("\n  {:14} {}", s->name, s->title);
    std::string recorded;
    for (const auto* s : recorded_studies) recorded += fmt::format("\n  {:14} {}", s->name, s->title);
    std::string of_kits;
    for (const auto* s : kit_studies) of_kits += fmt::format("\n  {:14} {}", s->name, s->title);
    return "Studies:" + known + "\n\nStudies of recordings, not part of 'all' (CORPUSCLE_DATA: directory of the recordings):" + recorded +
           "\n\nStudies of a foundry's kit in ngspice, not part of 'all' (CORPUSCLE_FOUNDRY_CARD: its file; also _MAP, _NCH, _PCH, "
           "_HV_NCH,\n"
           "_HV_PCH, as the options of 'corpuscle export'):" +
           of_kits +
           "\n\nExamples:\n  corpuscle study all --report reproduction.html\n  corpuscle study fig24 table17 --report chips.html\n"
           "  corpuscle study fig3 --json";
}

std::vector<std::string> study_names() {
    std::vector<std::string> out = {"all"};
    for (const auto* s : all_studies()) out.emplace_back(s->name);
    for (const auto* s : recorded_studies) out.emplace_back(s->name);
    for (const auto* s : kit_studies) out.emplace_back(s->name);
    return out;
}

Verb make_study_verb() {
    const auto args = std::make_shared<StudyArguments>();
    return {.name = "study",
            .description = "reproduce published results and compare them with the published numbers",
            .examples = study_help(),
            .options = {{"",
                         {suggesting(study_names, {"NAME", &args->names, "", "the studies to run (default: all)"}),
                          {"--report", &args->report_file, "FILE.html", "write a report page: figures, published and computed numbers"},
                          {"--markdown", &args->markdown_file, "FILE.md", "write all numbers as Markdown"}}}},
            .reports = true,
            .writes_files = true,
            .check = [args](const CommonArguments&) { return check_page_name(args->report_file); },
            .run = [args](const CommonArguments& common) { return study(*args, common); }};
}

}  // namespace

int main(int argc, char** argv) { return run_program("Corpuscle: the reproduction of the thesis.", "", {make_study_verb()}, argc, argv); }
