// corpuscle list POPULATION --sites

#include "cli/list_sites.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/output/terminal.hpp"
#include "core/text/csv_field.hpp"
#include "skin/plan/skin_plan.hpp"

namespace corpuscle {

Result<std::string> sites_listing(const std::vector<std::string>& populations, bool json) {
    if (populations.size() != 1)
        return bad_usage(
            fmt::format("list --sites takes one population, such as 'corpuscle list hand --sites', not {}", populations.size()));
    const auto plan = TRY(load_skin_plan(populations[0]));
    const auto& sites = plan.sites;
    if (json) {
        nlohmann::ordered_json out = {{"population", plan.name}, {"site_area_m2", sites.area}, {"sites", nlohmann::ordered_json::array()}};
        for (std::size_t s = 0; s < sites.size(); ++s)
            out["sites"].push_back({{"name", sites.names[s]},
                                    {"x_m", sites.positions[s].x},
                                    {"y_m", sites.positions[s].y},
                                    {"region", sites.regions[sites.region[s]]}});
        return json_text(out) + "\n";
    }
    std::string out = "name,x_mm,y_mm,region\n";
    for (std::size_t s = 0; s < sites.size(); ++s)
        out += fmt::format("{},{:.10g},{:.10g},{}\n", quote_csv_field(sites.names[s]), 1e3 * sites.positions[s].x,
                           1e3 * sites.positions[s].y, quote_csv_field(sites.regions[sites.region[s]]));
    return out;
}

}  // namespace corpuscle
