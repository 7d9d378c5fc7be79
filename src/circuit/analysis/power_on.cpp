// A circuit switched on: all its sources rise from nothing, and it follows in time.

#include <algorithm>
#include <cmath>

#include "circuit/analysis/power_on.hpp"
#include "circuit/analysis/transient_plan.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double longest = 1e5;  // s: by then it stands, or it never will

/// The same circuit with sources that rise.
std::shared_ptr<const Circuit> rising(const TestBench& bench, double rise) {
    auto copy = std::make_shared<Circuit>(*bench.circuit);
    copy->ic.clear();
    for (std::size_t k = 0; k < copy->elements.size(); ++k) {
        auto& e = copy->elements[k];
        if (e.letter != 'v' && e.letter != 'i') continue;
        e.waveform = Waveform{};
        e.waveform.shape = Waveform::Shape::points;
        e.waveform.numbers = {0, 0, rise, bench.system.devices()[k]->setting().value_or(0)};
    }
    return copy;
}

}  // namespace

Result<std::optional<std::vector<double>>> powered_on(const TestBench& given, double rise) {
    auto made = TestBench::make(rising(given, rise));
    if (!made) return made.error();
    auto& bench = **made;
    if (given.drawn()) bench.system.draw(&*given.drawn());
    auto plan = transient_plan(*bench.circuit);
    if (!plan) return plan.error();
    plan->stop = longest, plan->longest = longest / 50;
    bench.system.go(rise, longest);
    bench.newton.instant.time = 0, bench.newton.instant.charges = false;
    Transient transient(bench.system, bench.newton, *plan);
    if (auto ok = transient.begin(std::vector<double>(static_cast<std::size_t>(bench.system.size())), false); !ok) return ok.error();
    constexpr long most_steps = 200'000;  // one that swings on
    while (transient.time() < longest) {
        if (transient.work().steps > most_steps) return std::optional<std::vector<double>>();
        if (auto stepped = transient.step(longest); !stepped)
            return stepped.error();
        else if (!*stepped)
            break;
    }
    return std::optional(std::vector<double>(transient.x().begin(), transient.x().end()));
}

}  // namespace corpuscle::circuit
