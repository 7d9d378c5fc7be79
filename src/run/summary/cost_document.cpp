#include "run/summary/cost_document.hpp"

#include <nlohmann/json.hpp>

namespace corpuscle {
namespace {

/// The energy that all copies of one afferent used. The statistics have one entry for each copy; the copies of an afferent are adjacent,
/// and every afferent has the same number of them.
EnergyUse energy_used_by(const RunStats& stats, std::size_t afferent, std::size_t afferent_count) {
    EnergyUse out;
    const std::size_t copies = stats.energy_use.size() / afferent_count;
    for (std::size_t k = 0; k < copies; ++k) out += stats.energy_use[afferent * copies + k];
    return out;
}

}  // namespace

nlohmann::ordered_json cost_documents_of(std::span<const AfferentPlan> afferents, const RunStats& stats, double force) {
    auto out = nlohmann::ordered_json::array();
    for (std::size_t a = 0; a < afferents.size(); ++a) {
        const auto cost = afferents[a].factory->cost(force, energy_used_by(stats, a, afferents.size()));
        if (cost.is_null()) continue;
        out.push_back({{"afferent", afferents[a].name}, {"rest_force_N", force}});
        out.back().update(cost);
    }
    return out;
}

}  // namespace corpuscle
