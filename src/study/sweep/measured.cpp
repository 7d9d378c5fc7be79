#include "study/sweep/measured.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "measure/measures.hpp"

namespace corpuscle::sweeps {

AfferentMeasures::AfferentMeasures(const FeltForce& nominal, bool circuit, std::span<const std::string> ranges) {
    for (std::size_t m = 0; m < std::size(measures); ++m)
        known_.push_back(
            {Of::whole, m, "", {std::string(measures[m].name), std::string(measures[m].unit), std::string(measures[m].sentence)}});
    known_.push_back({Of::first, 0, "", {"first_spike", "s", "time of the first spike"}});
    known_.push_back({Of::last, 0, "", {"last_spike", "s", "time of the last spike"}});
    if (circuit) {
        known_.push_back({Of::power, 0, "", {"power", "W", "what all sources deliver, in the mean"}});
        known_.push_back({Of::sensor_power, 0, "", {"sensor_power", "W", "of that, what the sensor's current takes"}});
        known_.push_back({Of::outside, 0, "", {"outside", "s", "longest time outside one of its ranges"}});
        known_.push_back({Of::iterations, 0, "", {"iterations", "", "Newton's iterations"}});
        for (std::size_t r = 0; r < ranges.size(); ++r)
            known_.push_back(
                {Of::one_range, r, "", {"outside." + ranges[r], "s", fmt::format("time that {} is outside its range", ranges[r])}});
    }
    for (auto& one : known_) {
        const bool of_cycles =
            one.of == Of::whole && (one.column.name == VectorStrength::row.name || one.column.name == Entrainment::row.name);
        one.usual = one.of != Of::iterations && one.of != Of::one_range && !(of_cycles && nominal.cycle == 0);
    }
    for (const auto& phase : nominal.phases)
        for (std::size_t m = 0; m < std::size(measures); ++m)
            known_.push_back({Of::phase,
                              m,
                              phase.name,
                              {fmt::format("{}.{}", measures[m].name, phase.name), std::string(measures[m].unit),
                               fmt::format("{} ({})", measures[m].sentence, phase.name)}});
}

Result<void> AfferentMeasures::choose(const std::optional<std::vector<Said>>& names) {
    if (names) {
        for (const auto& name : *names) {
            const auto before = columns_.size();
            const auto column = column_of(name);
            if (!column) return column.error();
            if (columns_.size() == before) return name.wrong(fmt::format("measures: '{}' is asked for twice", name.text));
        }
        return {};
    }
    for (const auto& one : known_)
        if (one.usual) all_.push_back(one), columns_.push_back(one.column);
    return {};
}

Result<std::size_t> AfferentMeasures::column_of(const Said& name) {
    for (std::size_t k = 0; k < columns_.size(); ++k)
        if (columns_[k].name == name.text) return k;
    for (const auto& one : known_)
        if (one.column.name == name.text) {
            all_.push_back(one), columns_.push_back(one.column);
            return columns_.size() - 1;
        }
    std::vector<std::string_view> names;
    std::string whole;
    for (const auto& one : known_) {
        names.push_back(one.column.name);
        if (one.of != Of::phase) whole += (whole.empty() ? "" : ", ") + one.column.name;
    }
    return name.wrong(fmt::format("there is no measure '{}'{} (there are {}; and of a phase, as in {})", name.text,
                                  did_you_mean(name.text, names), whole, names.back()));
}

std::vector<double> AfferentMeasures::values(const FeltForce& force, const UnitAnswer& answered) const {
    std::vector<Stretch> stretches;
    for (const auto& p : force.phases) stretches.push_back({p.from, p.to, force.cycle});
    Tally whole({{.cycle = force.cycle}}, 1), phases(std::move(stretches), 1);
    const bool by_phase = std::any_of(all_.begin(), all_.end(), [](const One& o) { return o.of == Of::phase; });
    for (const double t : answered.spikes) {
        whole.spike(0, t);
        if (by_phase) phases.spike(0, t);
    }
    whole.end(force.end()), phases.end(force.end());
    const auto all = whole.values(0, 0);
    std::vector<std::vector<double>> of_phase;
    for (std::size_t p = 0; by_phase && p < force.phases.size(); ++p) of_phase.push_back(phases.values(0, p));
    std::vector<double> out;
    for (const auto& one : all_) {
        double value = no_value;
        const auto& spikes = answered.spikes;
        if (one.of == Of::whole) value = all[one.number];
        if (one.of == Of::first && !spikes.empty()) value = spikes.front();
        if (one.of == Of::last && !spikes.empty()) value = spikes.back();
        if (one.of == Of::power) value = answered.power;
        if (one.of == Of::sensor_power) value = answered.sensor_power;
        if (one.of == Of::outside) value = answered.outside;
        if (one.of == Of::one_range) value = answered.outside_of[one.number];
        if (one.of == Of::iterations) value = answered.iterations;
        for (std::size_t p = 0; one.of == Of::phase && p < of_phase.size(); ++p)
            if (force.phases[p].name == one.phase) value = of_phase[p][one.number];
        out.push_back(value);
    }
    return out;
}

}  // namespace corpuscle::sweeps
