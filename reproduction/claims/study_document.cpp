#include "reproduction/claims/study_document.hpp"

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>

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

/// Number of claims that agree with the published value or the allowed range, and of claims that deviate from it.
struct VerdictCount {
    int agreeing = 0, deviating = 0;
    void add(const Claim& c) { c.needs_explanation() ? ++deviating : ++agreeing; }
};

/// Puts the table of all claims of one study.
void put_study_table(std::string& text, const StudyResult& outcome) {
    if (outcome.claims.empty()) return;
    text += "| | computed | published | deviation | allowed | | source, reason |\n|---|---|---|---|---|---|---|\n";
    for (const auto& c : outcome.claims)
        text += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", markdown_cell(c.label), format_claim_value(c.computed, c),
                            format_published(c), format_deviation(c), format_allowed_range(c), c.verdict(),
                            markdown_cell(c.source + (c.source.empty() || c.note.empty() ? "" : "; ") + c.note));
    text += '\n';
}

/// Puts the table of the headline claims of all studies.
void put_headline_table(std::string& text, std::span<const Study* const> studies, std::span<const StudyResult> outcomes) {
    text += "| study | quantity | computed | published | deviation | allowed | reason, if it deviates |\n|---|---|---|---|---|---|---|\n";
    for (std::size_t k = 0; k < studies.size(); ++k)
        for (const auto& c : outcomes[k].claims)
            if (is_headline(c))
                text += fmt::format("| [{0}](#{0}) | {1} | {2} | {3} | {4} | {5} | {6} |\n", studies[k]->name, markdown_cell(c.label),
                                    format_claim_value(c.computed, c), format_published(c), format_deviation(c), format_allowed_range(c),
                                    c.needs_explanation() ? markdown_cell(c.note) : "");
}

}  // namespace

bool is_headline(const Claim& c) { return c.needs_explanation() || (!std::isnan(c.published) && !c.is_derived); }

std::string verdict_counts(std::span<const StudyResult> outcomes) {
    VerdictCount published, derived, ranges;  // ranges: claims with an allowed range, or of a statement
    for (const auto& outcome : outcomes)
        for (const auto& c : outcome.claims)
            if (*c.verdict() != 0) (c.has_allowed_range() ? ranges : c.is_derived ? derived : published).add(c);
    return fmt::format(
        "{} published numbers agree within 10 %, {} differ by more. {} numbers agree within 10 % with values that an equation, a sentence "
        "or "
        "the thesis's model gives (in brackets), {} differ by more. {} claims of a range or a statement hold, {} do not.",
        published.agreeing, published.deviating, derived.agreeing, derived.deviating, ranges.agreeing, ranges.deviating);
}

Json document_of(const Study& study, const StudyResult& outcome) {
    Json claims = Json::array(), plots = Json::array();
    for (const auto& c : outcome.claims) claims.push_back(document_of(c));
    for (const auto& p : outcome.plots) plots.push_back(document_of(p));
    return {{"name", study.name}, {"title", study.title}, {"question", study.question},
            {"claims", claims},   {"plots", plots},       {"notes", outcome.notes}};
}

std::string markdown_of(std::span<const Study* const> studies, std::span<const StudyResult> outcomes) {
    const bool from_recording = !studies.empty() && !studies.front()->recording_folder.empty();
    std::string text = fmt::format(
        "# {}, reproduced\n\nWritten by `corpuscle study {}` (`make reproduction` writes this page{}). All numbers are "
        "computed, except the published ones. {} Deviations have a reason if one is known.\n\n## Published numbers, and deviations\n\n",
        from_recording ? "A published recording" : "Every figure and table", from_recording ? studies.front()->name : "all",
        from_recording ? " if the recording is in CORPUSCLE_DATA" : ", and `out/reproduction.html` with the pictures",
        verdict_counts(outcomes));
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
