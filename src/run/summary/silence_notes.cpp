#include "run/summary/silence_notes.hpp"

#include <fmt/format.h>

#include "model/catalog.hpp"
#include "run/firing_factor.hpp"

namespace corpuscle {
namespace {

std::string silence_message(const std::string& name, const SilentClass& silent) {
    const auto never = fmt::format("{} never fired: the largest force was {:.3g} N", name, silent.max_force);
    if (silent.factor) return fmt::format("{}; it would fire at about {} times this force", never, format_rounded_up(*silent.factor));
    return silent.max_force > 0 ? fmt::format("{}, and even a million times this force would not make it fire", never) : never;
}

}  // namespace

std::string nerve_advice(const AfferentPlan& plan) {
    const auto name = plan.name + "-nerve";
    const auto calibrated = plan_afferent(name);
    const bool is_other = calibrated && (calibrated->receptor != plan.receptor || calibrated->neuron != plan.neuron);
    return is_other ? fmt::format("try {}, which is calibrated to recordings of nerves", name) : "";
}

std::string silence_note(const AfferentPlan& plan, const SilentClass& silent) {
    const auto advice = nerve_advice(plan);
    return silence_message(plan.name, silent) + (advice.empty() ? "" : "; " + advice);
}

}  // namespace corpuscle
