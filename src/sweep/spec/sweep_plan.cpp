#include <algorithm>

#include "core/number/elementary.hpp"
#include "sweep/spec/axis.hpp"
#include "sweep/spec/probability.hpp"

namespace corpuscle::sweeps {

double SweepAxis::sample(std::uint64_t index) const {
    const double u = numbers->at(index);
    if (is_normal)
        return first +
               second * normal_quantile(std::clamp(min_probability + u * (max_probability - min_probability), 0x1p-1000, 1 - 0x1p-53));
    return is_logarithmic ? first * num::exp(u * num::log(second / first)) : first + u * (second - first);
}

std::int64_t SweepPlan::item_count() const {
    auto count = samples;
    for (const auto& a : axes)
        if (!a.values.empty()) count *= static_cast<std::int64_t>(a.values.size());
    return count;
}

std::vector<SweepColumn> SweepPlan::columns() const {
    std::vector<SweepColumn> out;
    for (const auto& a : axes) out.push_back(a.column);
    if (!chips.has_process) return out;
    for (const auto& [name, description] : {std::pair{"process.V_T0_n", "threshold of a chip's N devices"},
                                            {"process.V_T0_p", "threshold of a chip's P devices"},
                                            {"process.I_SQ_n", "specific current of a chip's N devices"},
                                            {"process.I_SQ_p", "specific current of a chip's P devices"}})
        out.push_back({name, "", std::string(description) + ", in standard deviations"});
    return out;
}

std::vector<double> SweepPlan::values(std::int64_t item) const {
    if (point) {
        auto given = point(item);
        const auto chip = given.chip && chips.has_process ? chips.sample(*given.chip) : circuit::ChipSample{};
        if (chips.has_process) given.values.insert(given.values.end(), std::begin(chip.process), std::end(chip.process));
        return given.values;
    }
    std::vector<double> out(axes.size());
    auto point = item / samples;
    const auto sample = static_cast<std::uint64_t>(item % samples);
    for (std::size_t k = axes.size(); k-- > 0;) {
        const auto& a = axes[k];
        if (a.values.empty()) {
            out[k] = a.sample(sample);
            continue;
        }
        const auto count = static_cast<std::int64_t>(a.values.size());
        out[k] = a.values[static_cast<std::size_t>(point % count)];
        point /= count;
    }
    if (chips.has_process) {
        const auto chip = chips.sample(sample);
        out.insert(out.end(), std::begin(chip.process), std::end(chip.process));
    }
    return out;
}

std::optional<circuit::ChipSample> SweepPlan::chip_sample(std::int64_t item) const {
    if (!samples_chips()) return {};
    if (point) {
        const auto chip = point(item).chip;
        return chip ? std::optional(chips.sample(*chip)) : std::nullopt;
    }
    return chips.sample(static_cast<std::uint64_t>(item % samples));
}

}  // namespace corpuscle::sweeps
