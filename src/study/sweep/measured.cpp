#include "study/sweep/measured.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "measure/measures.hpp"

namespace corpuscle::sweeps {

AfferentMeasures::AfferentMeasures(const FeltForce& nominal, bool circuit, std::span<const std::string> ranges) {
    for (std::size_t m = 0; m < std::size(measures); ++m)
        known_.push_back(
            {Of::whole, m, "", {std::string(measures[m].name), std::string(measures[m].unit), std::string(measures[m].description)}});
    known_.push_back({Of::first, 0, "", {"first_spike", "s", "time of the first spike"}});
    known_.push_back({Of::last, 0, "", {"last_spike", "s", "time of the last spike"}});
    if (circuit) {
        known_.push_back({Of::power, 0, "", {"power", "W", "mean power of all sources"}});
        known_.push_back({Of::sensor_power, 0, "", {"sensor_power", "W", "the part of it due to the sensor's current"}});
        known_.push_back({Of::outside, 0, "", {"outside", "s", "longest time outside one of its ranges"}});
        known_.push_back({Of::iterations, 0, "", {"iterations", "", "Newton iterations"}});
        for (std::size_t r = 0; r < ranges.size(); ++r)
            known_.push_back(
                {Of::one_range, r, "", {"outside." + ranges[r], "s", fmt::format("time that {} is outside its range", ranges[r])}});
    }
    for (auto& entry : known_) {
        const bool needs_cycle =
            entry.of == Of::whole && (entry.column.name == VectorStrength::info.name || entry.column.name == Entrainment::info.name);
        entry.usual = entry.of != Of::iterations && entry.of != Of::one_range && !(needs_cycle && nominal.cycle == 0);
    }
    for (const auto& phase : nominal.phases)
        for (std::size_t m = 0; m < std::size(measures); ++m)
            known_.push_back({Of::phase,
                              m,
                              phase.name,
                              {fmt::format("{}.{}", measures[m].name, phase.name), std::string(measures[m].unit),
                               fmt::format("{} ({})", measures[m].description, phase.name)}});
}

Result<void> AfferentMeasures::choose(const std::optional<std::vector<LocatedText>>& names) {
    if (names) {
        for (const auto& name : *names) {
            const auto before = columns_.size();
            const auto column = column_of(name);
            if (!column) return column.error();
            if (columns_.size() == before) return name.error_here(fmt::format("measures: '{}' is listed twice", name.text));
        }
        return {};
    }
    for (const auto& entry : known_)
        if (entry.usual) all_.push_back(entry), columns_.push_back(entry.column);
    return {};
}

Result<std::size_t> AfferentMeasures::column_of(const LocatedText& name) {
    for (std::size_t k = 0; k < columns_.size(); ++k)
        if (columns_[k].name == name.text) return k;
    for (const auto& entry : known_)
        if (entry.column.name == name.text) {
            all_.push_back(entry), columns_.push_back(entry.column);
            return columns_.size() - 1;
        }
    std::vector<std::string_view> names;
    std::string listed;
    for (const auto& entry : known_) {
        names.push_back(entry.column.name);
        if (entry.of != Of::phase) listed += (listed.empty() ? "" : ", ") + entry.column.name;
    }
    return name.error_here(fmt::format("unknown measure '{}'{} (known: {}; and for a phase, such as {})", name.text,
                                  did_you_mean(name.text, names), listed, names.back()));
}

std::vector<double> AfferentMeasures::values(const FeltForce& force, const UnitAnswer& response) const {
    std::vector<TimeWindow> stretches;
    for (const auto& p : force.phases) stretches.push_back({p.from, p.to, force.cycle});
    MeasureAccumulator total({{.stimulus_frequency = force.cycle}}, 1), phases(std::move(stretches), 1);
    const bool by_phase = std::any_of(all_.begin(), all_.end(), [](const One& o) { return o.of == Of::phase; });
    for (const double t : response.spikes) {
        total.spike(0, t);
        if (by_phase) phases.spike(0, t);
    }
    total.set_end(force.end()), phases.set_end(force.end());
    const auto all = total.values(0, 0);
    std::vector<std::vector<double>> phase_values;
    for (std::size_t p = 0; by_phase && p < force.phases.size(); ++p) phase_values.push_back(phases.values(0, p));
    std::vector<double> out;
    for (const auto& entry : all_) {
        double value = no_value;
        const auto& spikes = response.spikes;
        if (entry.of == Of::whole) value = all[entry.number];
        if (entry.of == Of::first && !spikes.empty()) value = spikes.front();
        if (entry.of == Of::last && !spikes.empty()) value = spikes.back();
        if (entry.of == Of::power) value = response.power;
        if (entry.of == Of::sensor_power) value = response.sensor_power;
        if (entry.of == Of::outside) value = response.outside;
        if (entry.of == Of::one_range) value = response.outside_of[entry.number];
        if (entry.of == Of::iterations) value = response.iterations;
        for (std::size_t p = 0; entry.of == Of::phase && p < phase_values.size(); ++p)
            if (force.phases[p].name == entry.phase) value = phase_values[p][entry.number];
        out.push_back(value);
    }
    return out;
}

}  // namespace corpuscle::sweeps
