#include "skin/taxel/taxel_map.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <map>

#include "core/text/ascii_text.hpp"
#include "skin/taxel/taxel_placement.hpp"

namespace corpuscle {
namespace {

/// The share of one taxel in the force of another, or of a site.
struct Share {
    std::uint32_t index;
    double weight;
};

/// Divides the weights by their sum. The largest one takes the rounding error, so that their sum in order is 1 again.
void normalise(std::vector<Share>& shares) {
    const auto sum = [&] {
        double total = 0;
        for (const auto& s : shares) total += s.weight;
        return total;
    };
    const double total = sum();
    for (auto& s : shares) s.weight /= total;
    auto& largest = *std::max_element(shares.begin(), shares.end(), [](const Share& a, const Share& b) { return a.weight < b.weight; });
    for (int attempt = 0; attempt < 4 && sum() != 1; ++attempt) largest.weight += 1 - sum();
}

/// The measured taxels whose forces replace that of a dead one.
Result<std::vector<Share>> neighbours(const TaxelLayout& layout, const std::vector<Position>& centres, std::size_t dead) {
    constexpr std::size_t max_neighbours = 4;
    std::vector<std::pair<double, std::uint32_t>> near;  // distance (m), taxel
    for (std::uint32_t k = 0; k < layout.taxels.size(); ++k)
        if (layout.taxels[k].use == TaxelUse::measured && layout.taxels[k].pose == layout.taxels[dead].pose)
            near.emplace_back(distance_between(centres[k], centres[dead]), k);
    if (near.empty())
        return bad_input(fmt::format("taxel '{}' cannot be interpolated: its patch has no other taxel that is not dead; write dead = 1",
                                     layout.taxels[dead].name),
                         layout.taxels[dead].location);
    std::sort(near.begin(), near.end());
    near.resize(std::min(near.size(), max_neighbours));
    std::vector<Share> out;
    for (const auto& [distance, taxel] : near) out.push_back({taxel, 1 / std::max(distance, 1e-6)});
    normalise(out);
    return out;
}

/// The taxels whose forces make up that of a taxel: itself, its neighbours, or none.
Result<std::vector<Share>> force_shares(const TaxelLayout& layout, const std::vector<Position>& centres, std::uint32_t taxel) {
    switch (layout.taxels[taxel].use) {
        case TaxelUse::measured:
            return std::vector<Share>{{taxel, 1}};
        case TaxelUse::interpolated:
            return neighbours(layout, centres, taxel);
        case TaxelUse::excluded:
            break;
    }
    return std::vector<Share>();
}

/// Stores the shares of all sites in the map.
void store(const std::map<std::uint32_t, std::map<std::uint32_t, double>>& by_site, TaxelMap& map) {
    map.begin = {0};
    for (const auto& [site, taxels] : by_site) {
        map.sites.push_back(site);
        for (const auto& [taxel, weight] : taxels) map.taxel.push_back(taxel), map.weight.push_back(weight);
        map.begin.push_back(static_cast<std::uint32_t>(map.taxel.size()));
    }
}

/// Notes about dead taxels, points, and taxels at the edge of the skin.
std::vector<std::string> notes_about(const TaxelLayout& layout, const Sites& sites, const std::vector<PlacedTaxel>& placed) {
    constexpr std::size_t max_names = 6;
    std::vector<std::string> partly, dead, points, out;
    for (std::size_t k = 0; k < placed.size(); ++k) {
        const auto& t = layout.taxels[k];
        if (t.use != TaxelUse::measured) dead.push_back(t.name);
        if (placed[k].fraction_on_skin < 1 - 1e-6) partly.push_back(fmt::format("{} ({:.0f} %)", t.name, 100 * placed[k].fraction_on_skin));
        if (t.area == 0) points.push_back(t.name);
    }
    const auto add = [&](std::vector<std::string>& names, const std::string& text) {
        if (names.empty()) return;
        const auto count = names.size();
        if (count > max_names) names.resize(max_names), names.push_back("...");
        out.push_back(fmt::format("{} of {} taxels {}: {}", count, placed.size(), text, joined(names)));
    };
    add(partly, "are partly off the skin; their complete force acts on the part that is on it");
    add(dead, "are dead, and their readings are not used");
    const auto cell = sites.area > 0 ? fmt::format("one site, {:.3g} mm2 of skin", 1e6 * sites.area) : "one site";
    add(points, fmt::format("have no area, so the complete force of each acts on {}", cell));
    return out;
}

}  // namespace

void TaxelMap::spread(const double* taxels, double* force, std::size_t stride) const {
    for (std::size_t k = 0; k < sites.size(); ++k) {
        double sum = 0;
        for (auto e = begin[k]; e < begin[k + 1]; ++e) sum += weight[e] * taxels[taxel[e]];
        force[sites[k] * stride] = sum;
    }
}

Result<TaxelMap> map_taxels(const TaxelLayout& layout, const Sites& sites) {
    const auto placed = TRY(place_taxels(layout, sites));
    std::vector<Position> centres;
    for (const auto& p : placed) centres.push_back(p.centre);
    TaxelMap map;
    map.taxel_count = layout.taxels.size(), map.total.resize(map.taxel_count);
    std::map<std::uint32_t, std::map<std::uint32_t, double>> by_site;  // for each site, the weight of each taxel
    for (std::uint32_t k = 0; k < placed.size(); ++k) {
        std::vector<Share> on_sites;
        for (const auto& [site, overlap] : placed[k].overlaps) on_sites.push_back({site, overlap});
        normalise(on_sites);
        const auto force = TRY(force_shares(layout, centres, k));
        for (const auto& from : force) {
            map.total[from.index] += from.weight;
            for (const auto& to : on_sites) by_site[to.index][from.index] += from.weight * to.weight;
        }
    }
    store(by_site, map);
    map.notes = notes_about(layout, sites, placed);
    return map;
}

}  // namespace corpuscle
