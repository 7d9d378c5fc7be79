#include "sweep/subject/afferent_measures.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "measure/measures.hpp"

namespace corpuscle::sweeps {

AfferentMeasures::AfferentMeasures(const SweepForce& nominal, bool is_circuit, std::span<const std::string> ranges) {
    for (std::size_t m = 0; m < std::size(measures); ++m)
        available_.push_back(
            {Kind::total, m, "", {std::string(measures[m].name), std::string(measures[m].unit), std::string(measures[m].description)}});
    available_.push_back({Kind::first, 0, "", {"first_spike", "s", "time of the first spike"}});
    available_.push_back({Kind::last, 0, "", {"last_spike", "s", "time of the last spike"}});
    if (is_circuit) {
        available_.push_back({Kind::power, 0, "", {"power", "W", "mean power of all sources"}});
        available_.push_back({Kind::sensor_power, 0, "", {"sensor_power", "W", "the part of the power due to the sensor's current"}});
        available_.push_back({Kind::outside,
                              0,
                              "",
                              {"outside", "s", "total time outside an operating range; with several ranges, the longest of their times"}});
        available_.push_back({Kind::iterations, 0, "", {"iterations", "", "Newton iterations"}});
        for (std::size_t r = 0; r < ranges.size(); ++r)
            available_.push_back(
                {Kind::one_range, r, "", {"outside." + ranges[r], "s", fmt::format("total time that {} is outside its range", ranges[r])}});
    }
    for (auto& entry : available_) {
        const bool needs_cycle =
            entry.kind == Kind::total && (entry.column.name == VectorStrength::info.name || entry.column.name == Entrainment::info.name);
        entry.is_default =
            entry.kind != Kind::iterations && entry.kind != Kind::one_range && !(needs_cycle && nominal.cycle_frequency == 0);
    }
    for (const auto& phase : nominal.phases)
        for (std::size_t m = 0; m < std::size(measures); ++m)
            available_.push_back({Kind::phase,
                                  m,
                                  phase.name,
                                  {fmt::format("{}.{}", measures[m].name, phase.name), std::string(measures[m].unit),
                                   fmt::format("{} ({})", measures[m].description, phase.name)}});
}

Result<void> AfferentMeasures::select(const std::optional<std::vector<LocatedText>>& names) {
    if (names) {
        for (const auto& name : *names) {
            const auto before = columns_.size();
            TRY(require_column(name));
            if (columns_.size() == before) return name.error_here(fmt::format("measures: '{}' is listed twice", name.text));
        }
        return {};
    }
    for (const auto& entry : available_)
        if (entry.is_default) selected_.push_back(entry), columns_.push_back(entry.column);
    return {};
}

Result<std::size_t> AfferentMeasures::require_column(const LocatedText& name) {
    for (std::size_t k = 0; k < columns_.size(); ++k)
        if (columns_[k].name == name.text) return k;
    for (const auto& entry : available_)
        if (entry.column.name == name.text) {
            selected_.push_back(entry), columns_.push_back(entry.column);
            return columns_.size() - 1;
        }
    std::vector<std::string_view> names;
    std::string listed;
    for (const auto& entry : available_) {
        names.push_back(entry.column.name);
        if (entry.kind != Kind::phase) listed += (listed.empty() ? "" : ", ") + entry.column.name;
    }
    return name.error_here(fmt::format("unknown measure '{}'{} (known: {}; for one phase: {}, for example)", name.text,
                                       did_you_mean(name.text, names), listed, names.back()));
}

std::vector<double> AfferentMeasures::values(const SweepForce& force, const ItemResponse& response) const {
    std::vector<TimeWindow> windows;
    for (const auto& p : force.phases) windows.push_back({p.from, p.to, force.cycle_frequency});
    // The accumulators have one train, with index 0.
    MeasureAccumulator total({{.stimulus_frequency = force.cycle_frequency}}, 1), phases(std::move(windows), 1);
    const bool by_phase = std::any_of(selected_.begin(), selected_.end(), [](const Entry& entry) { return entry.kind == Kind::phase; });
    for (const double t : response.spikes) {
        total.spike(0, t);
        if (by_phase) phases.spike(0, t);
    }
    total.set_end(force.end()), phases.set_end(force.end());
    const auto all = total.values(0, 0);
    std::vector<std::vector<double>> phase_values;
    for (std::size_t p = 0; by_phase && p < force.phases.size(); ++p) phase_values.push_back(phases.values(0, p));
    std::vector<double> out;
    for (const auto& entry : selected_) {
        double value = no_value;
        const auto& spikes = response.spikes;
        if (entry.kind == Kind::total) value = all[entry.index];
        if (entry.kind == Kind::first && !spikes.empty()) value = spikes.front();
        if (entry.kind == Kind::last && !spikes.empty()) value = spikes.back();
        if (entry.kind == Kind::power) value = response.power;
        if (entry.kind == Kind::sensor_power) value = response.sensor_power;
        if (entry.kind == Kind::outside) value = response.time_outside;
        if (entry.kind == Kind::one_range) value = response.time_outside_ranges[entry.index];
        if (entry.kind == Kind::iterations) value = response.iterations;
        for (std::size_t p = 0; entry.kind == Kind::phase && p < phase_values.size(); ++p)
            if (force.phases[p].name == entry.phase) value = phase_values[p][entry.index];
        out.push_back(value);
    }
    return out;
}

}  // namespace corpuscle::sweeps
