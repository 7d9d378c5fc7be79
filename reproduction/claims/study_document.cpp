#include "reproduction/claims/study_document.hpp"

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "reproduction/claims/verdict_counts.hpp"
#include "run/summary/json_number.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

Json number_array(const std::vector<double>& values) {
    Json out = Json::array();
    for (const double x : values) out.push_back(json_number(x));
    return out;
}

Json document_of(const Claim& c) {
    return {{"label", c.label},
            {"computed", c.is_boolean ? Json(c.computed > 0) : json_number(c.computed)},
            {"unit", c.unit},
            {"published", json_number(c.published)},
            {"derived", c.is_derived},
            {"deviation", json_number(c.deviation())},
            {"low", c.is_boolean ? Json(nullptr) : json_number(c.allowed_min)},
            {"high", json_number(c.allowed_max)},
            {"tolerance", json_number(c.tolerance)},
            {"kind", c.kind ? Json(info_of(*c.kind).name) : Json(nullptr)},
            {"verdict", c.verdict()},
            {"source", c.source},
            {"note", c.note}};
}

Json document_of(const StudyPlot& p) {
    Json series = Json::array();
    constexpr const char* styles[] = {"line", "points", "raster", "path"};
    for (const auto& s : p.series)
        series.push_back(
            {{"name", s.name}, {"style", styles[static_cast<int>(s.style)]}, {"x", number_array(s.x)}, {"y", number_array(s.y)}});
    return {
        {"title", p.title}, {"published", p.published_shape}, {"x", p.x_label}, {"y", p.y_label}, {"log_x", p.log_x}, {"log_y", p.log_y},
        {"series", series}};
}

/// Text for a cell of a Markdown table.
std::string markdown_cell(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '|') out += '\\';
        out += c;
    }
    return out;
}

/// The name of the kind of a claim that has a verdict.
std::string_view kind_cell(const Claim& c) { return c.kind && *c.verdict() != 0 ? info_of(*c.kind).name : ""; }

/// Puts the counts of agreeing and deviating claims of each kind that occurs.
void put_kinds_table(std::string& text, std::span<const StudyResult> outcomes) {
    text +=
        "| kind | printed numbers agree | differ | derived numbers agree | differ | statements hold | do not hold | meaning |\n"
        "|---|---|---|---|---|---|---|---|\n";
    for (const auto& k : count_by_kind(outcomes))
        text +=
            fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", info_of(k.kind).name, k.printed.agreeing, k.printed.deviating,
                        k.derived.agreeing, k.derived.deviating, k.statements.agreeing, k.statements.deviating, info_of(k.kind).meaning);
}

/// Puts the table of all claims of one study.
void put_study_table(std::string& text, const StudyResult& outcome) {
    if (outcome.claims.empty()) return;
    text += "| | computed | published | deviation | allowed | | kind | source, reason |\n|---|---|---|---|---|---|---|---|\n";
    for (const auto& c : outcome.claims)
        text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", markdown_cell(c.label), format_claim_value(c.computed, c),
                            format_published(c), format_deviation(c), format_allowed_range(c), c.verdict(), kind_cell(c),
                            markdown_cell(c.source + (c.source.empty() || c.note.empty() ? "" : "; ") + c.note));
    text += '\n';
}

/// Puts the table of the headline claims of all studies.
void put_headline_table(std::string& text, std::span<const Study* const> studies, std::span<const StudyResult> outcomes) {
    text +=
        "| study | quantity | computed | published | deviation | allowed | kind | reason, if it deviates "
        "|\n|---|---|---|---|---|---|---|---|\n";
    for (std::size_t k = 0; k < studies.size(); ++k)
        for (const auto& c : outcomes[k].claims)
            if (is_headline(c))
                text += fmt::format("| [{0}](#{0}) | {1} | {2} | {3} | {4} | {5} | {6} | {7} |\n", studies[k]->name, markdown_cell(c.label),
                                    format_claim_value(c.computed, c), format_published(c), format_deviation(c), format_allowed_range(c),
                                    kind_cell(c), c.needs_explanation() ? markdown_cell(c.note) : "");
}

}  // namespace

bool is_headline(const Claim& c) { return c.needs_explanation() || (!std::isnan(c.published) && !c.is_derived); }

Json document_of_kinds(std::span<const StudyResult> outcomes) {
    Json out = Json::array();
    const auto count = [](const VerdictCount& v) { return Json{{"agreeing", v.agreeing}, {"deviating", v.deviating}}; };
    for (const auto& k : count_by_kind(outcomes))
        out.push_back({{"kind", info_of(k.kind).name},
                       {"meaning", info_of(k.kind).meaning},
                       {"printed", count(k.printed)},
                       {"derived", count(k.derived)},
                       {"statements", count(k.statements)}});
    return out;
}

Json document_of(const Study& study, const StudyResult& outcome) {
    Json claims = Json::array(), plots = Json::array();
    for (const auto& c : outcome.claims) claims.push_back(document_of(c));
    for (const auto& p : outcome.plots) plots.push_back(document_of(p));
    return {{"name", study.name}, {"title", study.title}, {"question", study.question},
            {"claims", claims},   {"plots", plots},       {"notes", outcome.notes}};
}

std::string markdown_of(std::span<const Study* const> studies, std::span<const StudyResult> outcomes) {
    const bool from_recordings = !studies.empty() && !studies.front()->recording_folder.empty();
    std::string names;
    for (const auto* study : studies) names += fmt::format("{}{}", names.empty() ? "" : " ", study->name);
    std::string text = fmt::format(
        "# {}, reproduced\n\nWritten by `corpuscle study {}` (`make reproduction` writes this page{}). All numbers are "
        "computed, except the published ones. {}\n\nA number agrees if it is within 10 % of the published one, or within the tolerance "
        "that its "
        "row states. A derived number, in brackets, is not printed but follows from an equation, a sentence or the thesis's model. Every "
        "deviation has its cause, or the words \"not known\".\n\n## Kinds of claims\n\n",
        from_recordings ? "Published recordings" : "Every figure and table", from_recordings ? names : "all",
        from_recordings ? " if the recordings are in CORPUSCLE_DATA" : ", and `out/reproduction.html` with the pictures",
        prediction_sentence(outcomes));
    put_kinds_table(text, outcomes);
    text += "\n## Published numbers, and deviations\n\n";
    put_headline_table(text, studies, outcomes);
    for (std::size_t k = 0; k < studies.size(); ++k) {
        text += fmt::format("\n## {}\n\n**{}.** {}\n\n", studies[k]->name, studies[k]->title, studies[k]->question);
        put_study_table(text, outcomes[k]);
        for (const auto& p : outcomes[k].plots)
            text += fmt::format("- Picture: {}.{}\n", p.title,
                                p.published_shape.empty() ? "" : fmt::format(" Published: {}", p.published_shape));
        for (const auto& n : outcomes[k].notes) text += fmt::format("- {}\n", n);
    }
    return text;
}

}  // namespace corpuscle
