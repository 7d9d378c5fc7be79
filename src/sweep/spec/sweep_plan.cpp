#include "sweep/spec/sweep_plan.hpp"
#include "sweep/spec/probability.hpp"

#include <algorithm>

#include "core/number/elementary.hpp"

namespace corpuscle::sweeps {

double SweepAxis::sample(std::uint64_t index) const {
    const double u = numbers->at(index);
    if (is_normal)
        return first +
               second * normal_quantile(std::clamp(min_probability + u * (max_probability - min_probability), 0x1p-1000, 1 - 0x1p-53));
    return is_logarithmic ? first * num::exp(u * num::log(second / first)) : first + u * (second - first);
}

SweepPlan::SweepPlan(std::vector<SweepAxis> axes, const circuit::ChipSpec& chips, std::int64_t samples)
    : axes_(std::move(axes)), chips_(chips), samples_(samples) {
    for (const auto& a : axes_) {
        columns_.push_back(a.column);
        if (!a.values.empty()) points_ *= static_cast<std::int64_t>(a.values.size());
    }
    if (!chips.has_process) return;
    for (const auto& [name, description] : {std::pair{"process.V_T0_n", "threshold of a chip's N devices"},
                                            {"process.V_T0_p", "threshold of a chip's P devices"},
                                            {"process.I_SQ_n", "specific current of a chip's N devices"},
                                            {"process.I_SQ_p", "specific current of a chip's P devices"}})
        columns_.push_back({name, "", std::string(description) + ", in standard deviations"});
}

std::vector<double> SweepPlan::values(std::int64_t item) const {
    std::vector<double> out(axes_.size());
    auto point = item / samples_;
    const auto sample = static_cast<std::uint64_t>(item % samples_);
    for (std::size_t k = axes_.size(); k-- > 0;) {
        const auto& a = axes_[k];
        if (a.values.empty()) {
            out[k] = a.sample(sample);
            continue;
        }
        const auto count = static_cast<std::int64_t>(a.values.size());
        out[k] = a.values[static_cast<std::size_t>(point % count)];
        point /= count;
    }
    if (chips_.has_process) {
        const auto chip = chips_.sample(sample);
        out.insert(out.end(), std::begin(chip.process), std::end(chip.process));
    }
    return out;
}

std::optional<circuit::ChipSample> SweepPlan::chip_sample(std::int64_t item) const {
    if (!samples_chips()) return {};
    return chips_.sample(static_cast<std::uint64_t>(item % samples_));
}

}  // namespace corpuscle::sweeps
