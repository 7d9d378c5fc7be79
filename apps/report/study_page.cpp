#include "report/study_page.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "report/template.hpp"
#include "signal/version.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json numbers(const std::vector<double>& values) {
    Json out = Json::array();
    for (const double x : values) out.push_back(number(x));
    return out;
}

Json claim_document(const Claim& c) {
    return {{"what", c.what},
            {"made", number(c.made)},
            {"unit", c.unit},
            {"printed", number(c.printed)},
            {"low", number(c.low)},
            {"high", number(c.high)},
            {"verdict", !c.judged() ? ""
                        : c.holds() ? "holds"
                                    : "does not hold"},
            {"source", c.source},
            {"note", c.note}};
}

Json plot_document(const Plot& p) {
    Json series = Json::array();
    constexpr const char* styles[] = {"line", "points", "raster"};
    for (const auto& s : p.series)
        series.push_back({{"name", s.name}, {"style", styles[static_cast<int>(s.style)]}, {"x", numbers(s.x)}, {"y", numbers(s.y)}});
    return {{"title", p.title}, {"x", p.x_label}, {"y", p.y_label}, {"log_x", p.log_x}, {"log_y", p.log_y}, {"series", series}};
}

}  // namespace

std::string study_page(std::span<const Study> studies, std::span<const Outcome> outcomes, const std::string& command) {
    Json all = Json::array();
    for (std::size_t k = 0; k < studies.size(); ++k) {
        Json claims = Json::array(), plots = Json::array();
        for (const auto& c : outcomes[k].claims) claims.push_back(claim_document(c));
        for (const auto& p : outcomes[k].plots) plots.push_back(plot_document(p));
        all.push_back({{"name", studies[k].name},
                       {"title", studies[k].title},
                       {"question", studies[k].question},
                       {"claims", claims},
                       {"plots", plots},
                       {"notes", outcomes[k].notes}});
    }
    const std::string title = studies.size() == 1 ? std::string(studies[0].title) : "Studies";
    const Json document = {{"title", title}, {"program", "corpuscle " + std::string(version)}, {"command", command}, {"studies", all}};
    return filled(asset("study.html"), escaped(title), safe_json(document));
}

}  // namespace corpuscle
