#include "circuit/device/expression_binding.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "circuit/device/physical_constants.hpp"
#include "core/parameter.hpp"

namespace corpuscle::circuit {
namespace {

std::string suggestion(std::string_view typed, const std::vector<std::string>& known) {
    const std::vector<std::string_view> names(known.begin(), known.end());
    return did_you_mean(typed, names);
}

}  // namespace

int ExpressionBinding::local_index(int unknown) {
    if (unknown < 0) return -1;
    const auto at = std::find(unknowns_.begin(), unknowns_.end(), unknown);
    if (at == unknowns_.end()) unknowns_.push_back(unknown);
    return static_cast<int>(std::find(unknowns_.begin(), unknowns_.end(), unknown) - unknowns_.begin());
}

Result<ExpressionBinding> ExpressionBinding::make(const Expression& expression, const Element& e, const DeviceSetup& setup,
                                                  std::vector<int> own) {
    ExpressionBinding out;
    out.unknowns_ = std::move(own);
    const Circuit& circuit = setup.circuit();
    for (const auto& in : expression.inputs()) {
        Input input;
        const auto node = [&](const std::string& name) -> Result<int> {
            const int number = circuit.find_node(name);
            if (number < 0)
                return bad_input(fmt::format("{}: unknown node '{}'{}", e.name, name, suggestion(name, circuit.nodes)), e.location);
            return setup.node_unknown(number);
        };
        switch (in.kind) {
            case ExpressionInput::Kind::voltage: {
                const int plus = TRY(node(in.name)), minus = in.minus.empty() ? -1 : TRY(node(in.minus));
                input.plus = out.local_index(plus), input.minus = out.local_index(minus);
                break;
            }
            case ExpressionInput::Kind::current: {
                const int element = circuit.find_element(in.name);
                if (element < 0 || setup.branch_unknown(element) < 0)
                    return bad_input(fmt::format("{}: i({}): no voltage source or inductor has this name", e.name, in.name), e.location);
                input.plus = out.local_index(setup.branch_unknown(element));
                break;
            }
            case ExpressionInput::Kind::time:
                input.is_time = true;
                break;
            case ExpressionInput::Kind::temperature:
                input.constant = setup.temperature(e) - zero_celsius;
                break;
        }
        out.inputs_.push_back(input);
    }
    return out;
}

}  // namespace corpuscle::circuit
