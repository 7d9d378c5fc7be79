#include "reproduction/page/study_page.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "report/envelope.hpp"
#include "report/page_template.hpp"
#include "reproduction/claims/study_document.hpp"
#include "reproduction/claims/verdict_counts.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

/// Reduces a long line plot to its minimum and maximum in each of 600 segments, so that peaks are kept and the page stays small. Other
/// styles are not reduced.
StudyPlot::Series thinned(const StudyPlot::Series& all) {
    constexpr std::size_t segments = 600;
    if (all.style != StudyPlot::Style::line || all.x.size() <= 2 * segments) return all;
    StudyPlot::Series out{all.name, {}, {}, all.style};
    for (std::size_t s = 0; s < segments; ++s) {
        const auto from = static_cast<std::ptrdiff_t>(s * all.y.size() / segments),
                   to = static_cast<std::ptrdiff_t>((s + 1) * all.y.size() / segments);
        const auto [smallest, largest] = std::minmax_element(all.y.begin() + from, all.y.begin() + to);
        for (const auto at : {std::min(smallest, largest), std::max(smallest, largest)})  // iterators, so the earlier one first
            out.x.push_back(all.x[static_cast<std::size_t>(at - all.y.begin())]), out.y.push_back(*at);
    }
    return out;
}

/// The numbers in single precision, which is enough for a plot.
Json plot_numbers(const std::vector<double>& values) { return array_document(std::vector<float>(values.begin(), values.end())); }

/// The document of a study, with reduced plots and with the formatted numbers of each claim.
Json page_document(const Study& study, StudyResult outcome) {
    for (auto& p : outcome.plots)
        for (auto& s : p.series) s = thinned(s);
    auto document = document_of(study, outcome);
    for (std::size_t p = 0; p < outcome.plots.size(); ++p)
        for (std::size_t s = 0; s < outcome.plots[p].series.size(); ++s) {
            const auto& series = outcome.plots[p].series[s];
            auto& shown = document["plots"][p]["series"][s];
            shown["x"] = plot_numbers(series.x), shown["y"] = plot_numbers(series.y);
        }
    for (std::size_t k = 0; k < outcome.claims.size(); ++k) {
        const auto& c = outcome.claims[k];
        document["claims"][k]["texts"] = {format_claim_value(c.computed, c), format_published(c), format_deviation(c),
                                          format_allowed_range(c)};
    }
    return document;
}

}  // namespace

std::string study_page(std::span<const Study* const> studies, std::span<const StudyResult> outcomes, const std::string& command) {
    Json all = Json::array();
    for (std::size_t k = 0; k < studies.size(); ++k) all.push_back(page_document(*studies[k], outcomes[k]));
    const std::string title = studies.size() == 1 ? std::string(studies[0]->title) : "Reproduction of all figures and tables";
    return report_page("study", title, command,
                       {{"headline", prediction_sentence(outcomes)},
                        {"kinds", document_of_kinds(outcomes)},
                        {"studies", all},
                        {"versions", versions_document()}});
}

}  // namespace corpuscle
