// corpuscle study: what was printed, made again and held against it.

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/output.hpp"
#include "report/study_page.hpp"
#include "signal/field.hpp"
#include "study/studies.hpp"
#include "study/study_document.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace corpuscle {
namespace {

Result<std::vector<const Study*>> chosen(const std::vector<std::string>& names) {
    std::vector<std::string_view> known = {"all"};
    for (const auto* s : all_studies) known.push_back(s->name);
    std::vector<const Study*> out;
    for (const auto& name : names) {
        if (std::find(known.begin(), known.end(), name) == known.end())
            return bad_usage(
                fmt::format("study: none is called '{}'{}; there are {}", name, did_you_mean(name, known), fmt::join(known, ", ")));
        for (const auto* s : all_studies)
            if ((name == "all" || name == s->name) && std::find(out.begin(), out.end(), s) == out.end()) out.push_back(s);
    }
    return out;
}

std::string text_of(const Study& study, const Outcome& outcome) {
    std::vector<std::vector<std::string>> rows = {{"", "made", "printed", "deviation", "allowed", ""}};
    for (const auto& c : outcome.claims)
        rows.push_back({c.what, quantity_of(c.made, c), quantity_of(c.printed, c), deviation_of(c), allowed_of(c), c.verdict()});
    std::string text = fmt::format("{}: {}\n{}\n\n{}", study.name, study.title, study.question, table(rows));
    for (const auto& c : outcome.claims)
        if (!c.note.empty()) text += fmt::format("\n{}: {}\n", c.what, c.note);
    for (const auto& n : outcome.notes) text += fmt::format("\n{}\n", n);
    return text;
}

Result<void> write(const std::string& path, const std::string& text) {
    auto file = OutputFile::create(path);
    if (!file) return file.error();
    if (auto ok = file->write(text); !ok) return ok;
    return file->commit();
}

Result<void> run(const StudyWords& words, const Common& common) {
    const auto all = chosen(words.names.empty() ? std::vector<std::string>{"all"} : words.names);
    if (!all) return all.error();
    const auto outcomes = [&] {
        Progress progress(common.quiet);
        return run_studies(*all, {[&](double share) { return progress.at(share), !interrupted(); }});
    }();
    if (!outcomes) return outcomes.error();
    if (!words.report_file.empty())
        if (auto ok = write(words.report_file, study_page(*all, *outcomes, common.command)); !ok) return ok;
    if (!words.markdown_file.empty())
        if (auto ok = write(words.markdown_file, markdown_of(*all, *outcomes)); !ok) return ok;
    if (common.json) {
        auto document = nlohmann::ordered_json::array();
        for (std::size_t k = 0; k < all->size(); ++k) document.push_back(document_of(*(*all)[k], (*outcomes)[k]));
        fmt::print("{}\n", document.dump(1));
    } else if (!common.quiet) {
        for (std::size_t k = 0; k < all->size(); ++k) fmt::print("{}{}", k ? "\n" : "", text_of(*(*all)[k], (*outcomes)[k]));
    }
    return {};
}

}  // namespace

int study(const StudyWords& words, const Common& common) {
    catch_interrupt();
    const auto done = run(words, common);
    return done ? 0 : fail(done.error());
}

}  // namespace corpuscle
