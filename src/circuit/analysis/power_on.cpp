// Power-on: a transient in which all sources rise from 0.

#include <algorithm>
#include <cmath>

#include "circuit/analysis/power_on.hpp"
#include "circuit/analysis/transient_plan.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double settling_time = 1e5;  // s: length of the transient, after which the circuit has settled or oscillates

/// A copy of the circuit without .ic, whose sources rise from 0 to their DC values within `rise` (s).
std::shared_ptr<const Circuit> with_rising_sources(const AnalysisContext& context, double rise) {
    auto copy = std::make_shared<Circuit>(*context.circuit);
    copy->ic.clear();
    for (std::size_t k = 0; k < copy->elements.size(); ++k) {
        auto& e = copy->elements[k];
        if (e.letter != 'v' && e.letter != 'i') continue;
        e.waveform = Waveform{};
        e.waveform.shape = Waveform::Shape::piecewise_linear;
        e.waveform.numbers = {0, 0, rise, context.system.devices()[k]->principal_value().value_or(0)};
    }
    return copy;
}

}  // namespace

Result<std::optional<std::vector<double>>> power_on_state(const AnalysisContext& original, double rise) {
    auto copy = TRY(AnalysisContext::make(with_rising_sources(original, rise)));
    auto& context = *copy;
    if (original.chip_sample()) context.system.apply_variation(&*original.chip_sample());
    auto plan = TRY(read_transient_plan(*context.circuit));
    plan.stop = settling_time, plan.max_step = settling_time / 50;
    context.system.start_transient(rise, settling_time);
    context.newton.context.time = 0, context.newton.context.with_charges = false;
    Transient transient(context.system, context.newton, plan);
    TRY(transient.begin(std::vector<double>(static_cast<std::size_t>(context.system.size())), false));
    constexpr long max_steps = 200'000;  // exceeded only by an oscillating circuit
    while (transient.time() < settling_time) {
        if (transient.stats().steps > max_steps) return std::optional<std::vector<double>>();
        if (auto stepped = transient.step(settling_time); !stepped)
            return stepped.error();
        else if (!*stepped)
            break;
    }
    return std::optional(std::vector<double>(transient.x().begin(), transient.x().end()));
}

}  // namespace corpuscle::circuit
