#include "reproduction/thesis/chip_conditions.hpp"

#include <fmt/format.h>
#include <array>

#include "circuit/variant/netlist_overrides.hpp"
#include "reproduction/claims/trial.hpp"
#include "reproduction/thesis/chip_runs.hpp"

namespace corpuscle {
namespace {

using circuit::Chip;
using circuit::ChipResponse;
using circuit::CircuitAfferentFactory;
using Design = std::shared_ptr<const CircuitAfferentFactory>;

/// The chip with the settings of a condition.
Result<Design> design_of(const std::string& chip, const ChipCondition& condition) {
    std::vector<ParameterOverride> overrides;
    for (const auto& text : {fmt::format("corner={}", condition.corner), fmt::format("supply={}", condition.supply),
                             fmt::format("temp={}", condition.celsius), fmt::format("hv_membrane={:d}", condition.high_threshold)})
        overrides.push_back(TRY(circuit::parse_netlist_override(chip, text)));
    const auto netlist = TRY(circuit::apply_overrides(chip, overrides));
    TRY(check_all_used(netlist.unused, std::array{std::string_view(chip)}));
    return CircuitAfferentFactory::create(netlist.result);
}

ConditionResponse response_of(const ChipCondition& condition, const CircuitAfferentFactory& design, ChipResponse&& response) {
    ConditionResponse out{condition, std::move(response.spikes), {}, response.error ? response.error->text() : ""};
    for (std::size_t k = 0; k < response.range_violations.size(); ++k)
        if (response.range_violations[k].samples > 0) out.range_warnings.push_back(design.operating_ranges[k].message);
    return out;
}

}  // namespace

Result<std::vector<ConditionResponse>> run_conditions(const std::string& chip, const std::vector<ChipCondition>& conditions,
                                                      const std::function<bool(std::size_t)>& progress) {
    if (conditions.empty()) return std::vector<ConditionResponse>();
    const auto force = TRY(trial_force({chip}));
    std::vector<Design> designs;
    for (const auto& condition : conditions) designs.push_back(TRY(design_of(chip, condition)));
    std::vector<Chip> chips;
    for (const auto& design : designs) chips.push_back({0, design, {}, force.force, force.clock.T()});
    auto responses = TRY(run_all_chips(std::move(chips), progress));
    std::vector<ConditionResponse> out;
    for (std::size_t k = 0; k < conditions.size(); ++k) out.push_back(response_of(conditions[k], *designs[k], std::move(responses[k])));
    return out;
}

}  // namespace corpuscle
