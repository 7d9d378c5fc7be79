#include "circuit/device/formula_inputs.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "circuit/device/constants.hpp"
#include "signal/field.hpp"

namespace corpuscle::circuit {
namespace {

std::string suggestion(std::string_view typed, const std::vector<std::string>& known) {
    const std::vector<std::string_view> names(known.begin(), known.end());
    return did_you_mean(typed, names);
}

}  // namespace

int FormulaInputs::local(int unknown) {
    if (unknown < 0) return -1;
    const auto at = std::find(unknowns_.begin(), unknowns_.end(), unknown);
    if (at == unknowns_.end()) unknowns_.push_back(unknown);
    return static_cast<int>(std::find(unknowns_.begin(), unknowns_.end(), unknown) - unknowns_.begin());
}

Result<FormulaInputs> FormulaInputs::make(const Formula& formula, const Element& e, const Setup& setup, std::vector<int> first) {
    FormulaInputs out;
    out.unknowns_ = std::move(first);
    const Circuit& circuit = setup.circuit();
    for (const auto& in : formula.inputs()) {
        Input found;
        const auto node = [&](const std::string& name) -> Result<int> {
            const int number = circuit.node(name);
            if (number < 0)
                return bad_input(fmt::format("{}: no node is called '{}'{}", e.name, name, suggestion(name, circuit.nodes)), e.place);
            return setup.node(number);
        };
        switch (in.kind) {
            case FormulaInput::Kind::voltage: {
                const auto plus = node(in.name), minus = in.minus.empty() ? Result<int>(-1) : node(in.minus);
                if (!plus) return plus.error();
                if (!minus) return minus.error();
                found.plus = out.local(*plus), found.minus = out.local(*minus);
                break;
            }
            case FormulaInput::Kind::current: {
                const int element = circuit.element(in.name);
                if (element < 0 || setup.branch(element) < 0)
                    return bad_input(fmt::format("{}: i({}): there is no voltage source or inductor of this name", e.name, in.name),
                                     e.place);
                found.plus = out.local(setup.branch(element));
                break;
            }
            case FormulaInput::Kind::time:
                found.is_time = true;
                break;
            case FormulaInput::Kind::temperature:
                found.constant = setup.temperature(e) - zero_celsius;
                break;
        }
        out.inputs_.push_back(found);
    }
    return out;
}

}  // namespace corpuscle::circuit
