#include <fmt/format.h>
#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>

#include "core/version.hpp"
#include "page/save/saved_spikes.hpp"
#include "page/temporary_directory.hpp"
#include "run/afferent_details.hpp"
#include "run/skin/skin_population.hpp"

namespace corpuscle::page {
namespace {

/// The plans of all units: rows, then the afferents of the skin.
Result<PlanTable> plan_table(const SavedSpikes& saved) {
    PlanTable out;
    if (saved.skin) out = TRY(SkinPopulation(*saved.skin).plan_table());
    std::vector<std::uint32_t> of_rows;
    for (const auto& row : saved.rows) of_rows.push_back(static_cast<std::uint32_t>(out.plans.size())), out.plans.push_back(row.plan());
    out.plan_of.insert(out.plan_of.begin(), of_rows.begin(), of_rows.end());
    return out;
}

AfferentNames afferent_names(const SavedSpikes& saved, const PlanTable& table) {
    auto [afferents, channels] = unit_names(saved);
    AfferentNames out{std::move(afferents), {}, std::move(channels), {}, {}};
    for (const auto p : table.plan_of) out.types.push_back(base_name(table.plans[p]));
    if (!saved.skin) return out;
    out.x = out.y = std::vector<double>(saved.rows.size(), std::numeric_limits<double>::quiet_NaN());
    for (const auto& afferent : saved.skin->afferents) out.x.push_back(afferent.position.x), out.y.push_back(afferent.position.y);
    return out;
}

Result<NwbUnits> units_of(const SavedSpikes& saved) {
    const auto table = TRY(plan_table(saved));
    NwbUnits out;
    out.description = fmt::format("simulated afferents (Corpuscle {})", version);
    out.trains.resize(table.plan_of.size());
    for (const auto& s : saved.spikes) out.trains[s.afferent_index].push_back(saved.clock.time(s.step, s.offset));
    out.from = saved.clock.t0, out.to = saved.clock.time(saved.samples);
    if (!saved.spikes.empty()) {
        const auto& first = saved.spikes.front();
        if (const double t = saved.clock.time(first.step, first.offset); !saved.is_complete || t < out.from) out.from = t;
    }
    for (const auto& train : out.trains)
        if (!train.empty()) out.to = std::max(out.to, train.back());  // nerve fibres conduct it after the end
    out.columns = nwb_columns(afferent_names(saved, table), details_of(table));
    return out;
}

}  // namespace

Result<std::string> spikes_nwb(const SavedSpikes& saved, const SavedForce& force) {
    const auto directory = TRY(TemporaryDirectory::make());
    const auto path = directory.file("spikes.nwb");
    auto file = TRY(NwbFile::create(path, {}));
    file.set_default_description("Simulated response to a press on the live page");
    file.add_provenance("the live page of corpuscle stream", fmt::format("Simulated by Corpuscle {}.", version));
    if (!force.values.empty()) {
        file.add_force({.name = "press",
                        .description = saved.skin ? "total normal force on the skin" : "normal force",
                        .channels = {"force"},
                        .start = saved.clock.time(force.first),
                        .rate = saved.clock.rate()});
        file.append_force(force.values);
    }
    TRY(file.add_units(TRY(units_of(saved))));
    TRY(file.commit());
    std::ifstream written(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(written), {});
}

}  // namespace corpuscle::page
