// corpuscle study: what was printed, made again and held against it.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/output.hpp"
#include "report/study_page.hpp"
#include "signal/field.hpp"
#include "signal/quantity.hpp"
#include "study/studies.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

Result<std::vector<Study>> chosen(const std::vector<std::string>& names) {
    std::vector<std::string_view> known = {"all"};
    for (const auto& s : studies) known.push_back(s.name);
    std::vector<Study> out;
    for (const auto& name : names) {
        if (std::find(known.begin(), known.end(), name) == known.end())
            return bad_usage(
                fmt::format("study: none is called '{}'{}; there are {}", name, did_you_mean(name, known), fmt::join(known, ", ")));
        for (const auto& s : studies)
            if (name == "all" || name == s.name) out.push_back(s);
    }
    return out;
}

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json document_of(const Study& study, const Outcome& outcome) {
    Json claims = Json::array();
    for (const auto& c : outcome.claims)
        claims.push_back({{"what", c.what},
                          {"made", number(c.made)},
                          {"unit", c.unit},
                          {"printed", number(c.printed)},
                          {"low", number(c.low)},
                          {"high", number(c.high)},
                          {"holds", c.judged() ? Json(c.holds()) : Json(nullptr)},
                          {"source", c.source},
                          {"note", c.note}});
    return {{"name", study.name}, {"title", study.title}, {"question", study.question}, {"claims", claims}, {"notes", outcome.notes}};
}

std::string quantity(double x, const Claim& c) {
    return std::isnan(x) ? "-" : c.unit.empty() ? fmt::format("{:.4g}", x) : format_quantity(x, c.unit);
}

std::string text_of(const Study& study, const Outcome& outcome) {
    std::vector<std::vector<std::string>> rows = {{"", "made", "printed", "allowed", ""}};
    for (const auto& c : outcome.claims)
        rows.push_back({c.what, quantity(c.made, c), quantity(c.printed, c),
                        c.judged() ? fmt::format("{} .. {}", quantity(c.low, c), quantity(c.high, c)) : "-",
                        !c.judged() ? ""
                        : c.holds() ? "holds"
                                    : "does not hold"});
    std::string text = fmt::format("{}: {}\n{}\n\n{}", study.name, study.title, study.question, table(rows));
    for (const auto& n : outcome.notes) text += fmt::format("\n{}\n", n);
    return text;
}

Result<void> run(const StudyWords& words, const Common& common) {
    const auto all = chosen(words.names.empty() ? std::vector<std::string>{"all"} : words.names);
    if (!all) return all.error();
    std::vector<Outcome> outcomes;
    {
        Progress progress(common.quiet);
        for (const auto& study : *all) {
            const auto done = static_cast<double>(outcomes.size());
            StudyOptions options{[&](double share) {
                progress.at((done + share) / static_cast<double>(all->size()));
                return !interrupted();
            }};
            auto outcome = study.run(options);
            if (!outcome) return outcome.error();
            outcomes.push_back(std::move(*outcome));
        }
    }
    if (!words.report_file.empty()) {
        auto file = OutputFile::create(words.report_file);
        if (!file) return file.error();
        if (auto ok = file->write(study_page(*all, outcomes, common.command)); !ok) return ok;
        if (auto ok = file->commit(); !ok) return ok;
    }
    Json document = Json::array();
    for (std::size_t k = 0; k < all->size(); ++k) {
        if (common.json)
            document.push_back(document_of((*all)[k], outcomes[k]));
        else if (!common.quiet)
            fmt::print("{}{}", k ? "\n" : "", text_of((*all)[k], outcomes[k]));
    }
    if (common.json) fmt::print("{}\n", document.dump(1));
    return {};
}

}  // namespace

int study(const StudyWords& words, const Common& common) {
    catch_interrupt();
    const auto done = run(words, common);
    return done ? 0 : fail(done.error());
}

}  // namespace corpuscle
