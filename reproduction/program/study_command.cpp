// corpuscle study: reproduces published results and compares them with the published numbers.

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cli/output/output_files.hpp"
#include "cli/output/terminal.hpp"
#include "core/parameter.hpp"
#include "io/output/output_check.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/study_document.hpp"
#include "reproduction/page/study_page.hpp"
#include "reproduction/program/study_command.hpp"
#include "run/earlier_outputs.hpp"

namespace corpuscle {
namespace {

/// True if `requested` is one of the figures, tables or equations that the name of a study covers: "table17" in table17-18, "eq40" in
/// eq34-41.
bool covers(std::string_view study, std::string_view requested) {
    const auto digits = requested.find_first_of("0123456789");
    if (digits == std::string_view::npos || digits == 0 || requested.find_first_not_of("0123456789", digits) != std::string_view::npos ||
        !study.starts_with(requested.substr(0, digits)))
        return false;
    int from = 0, to = 0, number = 0;
    const auto read = [](std::string_view text, int& out) { return std::from_chars(text.data(), text.data() + text.size(), out).ptr; };
    const auto* dash = read(study.substr(digits), from);
    const auto* end = study.data() + study.size();
    if (dash == end || *dash != '-' || read({dash + 1, static_cast<std::size_t>(end - dash - 1)}, to) != end) return false;
    read(requested.substr(digits), number);
    return number >= from && number <= to;
}

/// The studies that the names select, each of them once.
Result<std::vector<const Study*>> selected_studies(const std::vector<std::string>& names) {
    std::vector<std::string_view> known = {"all"};
    for (const auto* s : all_studies()) known.push_back(s->name);
    for (const auto* s : recorded_studies) known.push_back(s->name);
    for (const auto* s : kit_studies) known.push_back(s->name);
    std::vector<const Study*> out;
    for (const auto& name : names) {
        bool found = false;
        for (const auto* s : all_studies()) {
            if (name != "all" && name != s->name && !covers(s->name, name)) continue;
            found = true;
            if (std::find(out.begin(), out.end(), s) == out.end()) out.push_back(s);
        }
        const auto add_if_named = [&](const Study* s) {  // not part of "all"
            if (name == s->name && std::find(out.begin(), out.end(), s) == out.end()) found = true, out.push_back(s);
        };
        std::ranges::for_each(recorded_studies, add_if_named), std::ranges::for_each(kit_studies, add_if_named);
        if (!found)
            return bad_usage(
                fmt::format("study: unknown study '{}'{} (known: {})", name, did_you_mean(name, known), fmt::join(known, ", ")));
    }
    return out;
}

std::string text_of(const Study& study, const StudyResult& result) {
    std::vector<std::vector<std::string>> rows = {{"", "computed", "published", "deviation", "allowed", "", "kind"}};
    for (const auto& c : result.claims)
        rows.push_back({c.label, format_claim_value(c.computed, c), format_published(c), format_deviation(c), format_allowed_range(c),
                        c.verdict(), *c.verdict() != 0 ? std::string(info_of(*c.kind).name) : ""});
    std::string text = fmt::format("{}: {}\n{}\n\n{}", study.name, study.title, study.question, format_table(rows));
    for (const auto& c : result.claims)
        if (!c.note.empty()) text += fmt::format("\n{}: {}\n", c.label, c.note);
    for (const auto& n : result.notes) text += fmt::format("\n{}\n", n);
    return text;
}

/// The directory of the recordings that recorded_studies read: CORPUSCLE_DATA, or a default.
std::string recordings_directory() {
    const char* data = std::getenv("CORPUSCLE_DATA");
    return data && *data ? data : "../shared/data";
}

/// The kit that the environment names, for kit_studies.
KitRequest kit_of_environment() {
    const auto value = [](const char* name) {
        const char* text = std::getenv(name);
        return std::string(text ? text : "");
    };
    return {.card = value("CORPUSCLE_FOUNDRY_CARD"),
            .map = value("CORPUSCLE_FOUNDRY_MAP"),
            .nch = value("CORPUSCLE_FOUNDRY_NCH"),
            .pch = value("CORPUSCLE_FOUNDRY_PCH"),
            .hv_nch = value("CORPUSCLE_FOUNDRY_HV_NCH"),
            .hv_pch = value("CORPUSCLE_FOUNDRY_HV_PCH")};
}

Result<void> run(const StudyArguments& arguments, const CommonArguments& common) {
    const auto selected = TRY(selected_studies(arguments.names.empty() ? std::vector<std::string>{"all"} : arguments.names));
    OutputCheck outputs(common.overwrite);
    const std::pair<const std::string&, OutputCheck::Signature> files[] = {{arguments.report_file, is_own_page},
                                                                           {arguments.markdown_file, is_own_markdown}};
    for (const auto& [path, is_own] : files)
        if (!path.empty()) TRY(outputs.check_file(path, is_own));
    const auto outcomes = [&] {
        Progress progress(common.quiet);
        return run_studies(selected, {[&](double fraction) { return progress.update(fraction), !interrupted(); }, recordings_directory(),
                                      kit_of_environment()});
    }();
    if (!outcomes) return outcomes.error();
    if (!arguments.report_file.empty()) TRY(write_file(arguments.report_file, study_page(selected, *outcomes, common.command)));
    if (!arguments.markdown_file.empty()) TRY(write_file(arguments.markdown_file, markdown_of(selected, *outcomes)));
    if (common.json) {
        nlohmann::ordered_json document = {{"kinds", document_of_kinds(*outcomes)}, {"studies", nlohmann::ordered_json::array()}};
        for (std::size_t k = 0; k < selected.size(); ++k) document["studies"].push_back(document_of(*selected[k], (*outcomes)[k]));
        fmt::print("{}\n", document.dump(1));
    } else if (!common.quiet) {
        for (std::size_t k = 0; k < selected.size(); ++k) print_text((k ? "\n" : "") + text_of(*selected[k], (*outcomes)[k]));
    }
    return {};
}

}  // namespace

int study(const StudyArguments& arguments, const CommonArguments& common) {
    catch_interrupt();
    const auto done = run(arguments, common);
    return done ? 0 : report_error(done.error());
}

}  // namespace corpuscle
