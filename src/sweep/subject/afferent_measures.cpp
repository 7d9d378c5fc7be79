#include "sweep/subject/afferent_measures.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "measure/measures.hpp"

namespace corpuscle::sweeps {

AfferentMeasures::AfferentMeasures(const SweepForce& nominal, bool is_circuit, std::span<const std::string> ranges) {
    const auto column_of = [](const MeasureInfo& m) {
        return SweepColumn{std::string(m.name), std::string(m.unit), std::string(m.description)};
    };
    const auto add = [&](SweepColumn column, bool is_default, auto value, std::size_t index = 0) {
        available_.push_back({std::move(column), value, index, "", is_default});
    };
    for (std::size_t m = 0; m < std::size(measures); ++m) {
        const bool needs_cycle = measures[m].name == VectorStrength::info.name || measures[m].name == Entrainment::info.name;
        const bool is_default = !needs_cycle || nominal.cycle_frequency != 0;
        add(column_of(measures[m]), is_default, [](const Values& v, const Entry& entry) { return v.total[entry.index]; }, m);
    }
    add({"first_spike", "s", "time of the first spike"}, true,
        [](const Values& v, const Entry&) { return v.spikes.empty() ? no_value : v.spikes.front(); });
    add({"last_spike", "s", "time of the last spike"}, true,
        [](const Values& v, const Entry&) { return v.spikes.empty() ? no_value : v.spikes.back(); });
    if (is_circuit) {
        add({"power", "W", "mean power of all sources"}, true,
            [](const Values& v, const Entry&) { return v.response->energy_use.supplies / v.response->energy_use.seconds; });
        add({"sensor_power", "W", "the part of the power due to the sensor's current"}, true,
            [](const Values& v, const Entry&) { return v.response->energy_use.sensor / v.response->energy_use.seconds; });
        add({"own_power", "W", "the power without that part"}, false, [](const Values& v, const Entry&) {
            return (v.response->energy_use.supplies - v.response->energy_use.sensor) / v.response->energy_use.seconds;
        });
        add({"area", "m2", "area of arrays and capacitors"}, false, [](const Values& v, const Entry&) { return v.area; });
        add({"outside", "s", "total time outside an operating range; with several ranges, the longest of their times"}, true,
            [](const Values& v, const Entry&) {
                double longest = 0;
                for (std::size_t r = 0; r < v.response->range_violations.size(); ++r) longest = std::max(longest, v.time_outside(r));
                return longest;
            });
        add({"iterations", "", "Newton iterations"}, false,
            [](const Values& v, const Entry&) { return static_cast<double>(v.response->stats.iterations); });
        for (std::size_t r = 0; r < ranges.size(); ++r)
            add(
                {"outside." + ranges[r], "s", fmt::format("total time that {} is outside its range", ranges[r])}, false,
                [](const Values& v, const Entry& entry) { return v.time_outside(entry.index); }, r);
    }
    for (const auto& phase : nominal.phases)
        for (std::size_t m = 0; m < std::size(measures); ++m) {
            auto column = column_of(measures[m]);
            column.name += "." + phase.name, column.description += " (" + phase.name + ")";
            add(
                std::move(column), false,
                [](const Values& v, const Entry& entry) {
                    const auto at = v.of_phases.find(entry.phase);
                    return at == v.of_phases.end() ? no_value : at->second[entry.index];
                },
                m);
            available_.back().phase = phase.name;
        }
}

Result<void> AfferentMeasures::select(const ConfigNode* names) {
    if (names) {
        for (const auto& name : names->elements) {
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
        if (entry.phase.empty()) listed += (listed.empty() ? "" : ", ") + entry.column.name;
    }
    return name.error_here(fmt::format("unknown measure '{}'{} (known: {}; for one phase: {}, for example)", name.text,
                                       did_you_mean(name.text, names), listed, names.back()));
}

std::vector<double> AfferentMeasures::values(const SweepForce& force, std::span<const double> spikes, const circuit::ChipResponse* response,
                                             double area) const {
    std::vector<TimeWindow> windows;
    for (const auto& p : force.phases) windows.push_back({p.from, p.to, force.cycle_frequency});
    // The accumulators have one train, with index 0.
    MeasureAccumulator total({{.stimulus_frequency = force.cycle_frequency}}, 1), phases(std::move(windows), 1);
    const bool by_phase = std::any_of(selected_.begin(), selected_.end(), [](const Entry& entry) { return !entry.phase.empty(); });
    for (const double t : spikes) {
        total.spike(0, t);
        if (by_phase) phases.spike(0, t);
    }
    total.set_end(force.end()), phases.set_end(force.end());
    Values all{force, spikes, response, area, total.values(0, 0), {}};
    for (std::size_t p = 0; by_phase && p < force.phases.size(); ++p) all.of_phases[force.phases[p].name] = phases.values(0, p);
    std::vector<double> out;
    for (const auto& entry : selected_) out.push_back(entry.value(all, entry));
    return out;
}

bool AfferentMeasures::has_area() const {
    return std::any_of(columns_.begin(), columns_.end(), [](const SweepColumn& c) { return c.name == "area"; });
}

}  // namespace corpuscle::sweeps
