// Power-on: a transient in which all sources rise from 0.

#include <algorithm>
#include <cmath>

#include "circuit/analysis/power_on.hpp"
#include "circuit/analysis/transient_plan.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double settling_time = 1e5;  // s: after this time the circuit has settled or oscillates

/// A copy of the circuit with rising sources.
std::shared_ptr<const Circuit> with_rising_sources(const TestBench& context, double rise) {
    auto copy = std::make_shared<Circuit>(*context.circuit);
    copy->ic.clear();
    for (std::size_t k = 0; k < copy->elements.size(); ++k) {
        auto& e = copy->elements[k];
        if (e.letter != 'v' && e.letter != 'i') continue;
        e.waveform = Waveform{};
        e.waveform.shape = Waveform::Shape::piecewise_linear;
        e.waveform.numbers = {0, 0, rise, context.system.devices()[k]->setting().value_or(0)};
    }
    return copy;
}

}  // namespace

Result<std::optional<std::vector<double>>> powered_on(const TestBench& given, double rise) {
    auto made = TestBench::make(with_rising_sources(given, rise));
    if (!made) return made.error();
    auto& context = **made;
    if (given.drawn()) context.system.draw(&*given.drawn());
    auto plan = transient_plan(*context.circuit);
    if (!plan) return plan.error();
    plan->stop = settling_time, plan->longest = settling_time / 50;
    context.system.go(rise, settling_time);
    context.newton.instant.time = 0, context.newton.instant.charges = false;
    Transient transient(context.system, context.newton, *plan);
    if (auto ok = transient.begin(std::vector<double>(static_cast<std::size_t>(context.system.size())), false); !ok) return ok.error();
    constexpr long max_steps = 200'000;  // exceeded only by an oscillating circuit
    while (transient.time() < settling_time) {
        if (transient.work().steps > max_steps) return std::optional<std::vector<double>>();
        if (auto stepped = transient.step(settling_time); !stepped)
            return stepped.error();
        else if (!*stepped)
            break;
    }
    return std::optional(std::vector<double>(transient.x().begin(), transient.x().end()));
}

}  // namespace corpuscle::circuit
