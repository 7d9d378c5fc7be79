#include "reproduction/thesis/bias/bias_chips.hpp"

#include <fmt/format.h>

namespace corpuscle::bias_chips {

Result<Chips> simulate_chips(const std::string& circuit, const Variation& variation) {
    return run_study_variants(
        {circuit, {fmt::format("corner={}", variation.corner)}, fmt::format(".op\n.mc 1000 {}", variation.mc_options)});
}

double model_parameter(const circuit::Circuit& c, std::size_t element, const char* name) {
    return c.models[static_cast<std::size_t>(c.elements[element].model)].values.find(name)->second;
}

double channel_area(const circuit::Element& e) {
    double out = 1;
    for (const char* name : {"w", "l", "m", "stack"}) out *= e.values.find(name)->second;
    return out;
}

}  // namespace corpuscle::bias_chips
