// corpuscle study: reproduces published results and compares them with the published numbers.

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "io/output_check.hpp"
#include "output_files.hpp"
#include "own_files.hpp"
#include "report/study_page.hpp"
#include "signal/parameter.hpp"
#include "study/earlier_outputs.hpp"
#include "study/studies.hpp"
#include "study/study_document.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace corpuscle {
namespace {

/// True if `requested` lies in the range of a study: "table17" in table17-18, "eq40" in eq34-41.
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

Result<std::vector<const Study*>> chosen(const std::vector<std::string>& names) {
    std::vector<std::string_view> known = {"all"};
    for (const auto* s : all_studies) known.push_back(s->name);
    for (const auto* s : recorded_studies) known.push_back(s->name);
    std::vector<const Study*> out;
    for (const auto& name : names) {
        bool found = false;
        for (const auto* s : all_studies) {
            if (name != "all" && name != s->name && !covers(s->name, name)) continue;
            found = true;
            if (std::find(out.begin(), out.end(), s) == out.end()) out.push_back(s);
        }
        for (const auto* s : recorded_studies)
            if (name == s->name && std::find(out.begin(), out.end(), s) == out.end()) found = true, out.push_back(s);
        if (!found)
            return bad_usage(
                fmt::format("study: unknown study '{}'{} (known: {})", name, did_you_mean(name, known), fmt::join(known, ", ")));
    }
    return out;
}

std::string text_of(const Study& study, const StudyResult& outcome) {
    std::vector<std::vector<std::string>> rows = {{"", "computed", "published", "deviation", "allowed", ""}};
    for (const auto& c : outcome.claims)
        rows.push_back(
            {c.label, format_claim_value(c.computed, c), format_published(c), format_deviation(c), format_allowed_range(c), c.verdict()});
    std::string text = fmt::format("{}: {}\n{}\n\n{}", study.name, study.title, study.question, format_table(rows));
    for (const auto& c : outcome.claims)
        if (!c.note.empty()) text += fmt::format("\n{}: {}\n", c.label, c.note);
    for (const auto& n : outcome.notes) text += fmt::format("\n{}\n", n);
    return text;
}

/// The directory of third-party recordings.
std::string recordings_directory() {
    const char* set = std::getenv("CORPUSCLE_DATA");
    return set && *set ? set : "../shared/data";
}

Result<void> run(const StudyArguments& words, const CommonArguments& common) {
    const auto all = chosen(words.names.empty() ? std::vector<std::string>{"all"} : words.names);
    if (!all) return all.error();
    OutputCheck outputs(common.overwrite);
    const std::pair<const std::string&, OutputCheck::Signature> files[] = {{words.report_file, is_own_page},
                                                                           {words.markdown_file, is_own_markdown}};
    for (const auto& [path, ours] : files)
        if (!path.empty())
            if (auto ok = outputs.check_file(path, ours); !ok) return ok;
    const auto outcomes = [&] {
        Progress progress(common.quiet);
        return run_studies(*all, {[&](double fraction) { return progress.update(fraction), !interrupted(); }, recordings_directory()});
    }();
    if (!outcomes) return outcomes.error();
    if (!words.report_file.empty())
        if (auto ok = write_file(words.report_file, study_page(*all, *outcomes, common.command)); !ok) return ok;
    if (!words.markdown_file.empty())
        if (auto ok = write_file(words.markdown_file, markdown_of(*all, *outcomes)); !ok) return ok;
    if (common.json) {
        auto document = nlohmann::ordered_json::array();
        for (std::size_t k = 0; k < all->size(); ++k) document.push_back(document_of(*(*all)[k], (*outcomes)[k]));
        fmt::print("{}\n", document.dump(1));
    } else if (!common.quiet) {
        for (std::size_t k = 0; k < all->size(); ++k) print_text((k ? "\n" : "") + text_of(*(*all)[k], (*outcomes)[k]));
    }
    return {};
}

}  // namespace

int study(const StudyArguments& words, const CommonArguments& common) {
    catch_interrupt();
    const auto done = run(words, common);
    return done ? 0 : report_error(done.error());
}

}  // namespace corpuscle
