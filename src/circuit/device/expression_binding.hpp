#pragma once
// Binds the voltages and currents in an element's expression to the unknowns of the device.

#include "circuit/device/device.hpp"

namespace corpuscle::circuit {

/// For each voltage and current in an expression, the device's unknowns of which it is the difference.
class ExpressionBinding {
public:
    /// A part of the derivative of the expression's value with respect to one of the device's unknowns.
    struct Slope {
        std::size_t unknown;  ///< index into the device's unknowns
        double value;
    };

    /// `own`: unknowns (indices in the system) of the device's terminals and its branch current. unknowns() has these first, then those
    /// that only the expression uses.
    static Result<ExpressionBinding> make(const Expression&, const Element&, const DeviceSetup&, std::vector<int> own);

    const std::vector<int>& unknowns() const { return unknowns_; }

    /// Calls use(value, slopes) with the value and the derivatives of `expression`, which must be the one passed to make(). Several slopes
    /// may have the same unknown; their sum is the derivative.
    template <class Use>
    void eval(const Expression& expression, std::span<const double> v, const EvalContext& context, const Use& use) const {
        std::vector<double> values, derivatives(inputs_.size());
        for (const auto& in : inputs_) values.push_back(in.value(v, context));
        const double value = expression.value(values, derivatives);
        std::vector<Slope> slopes;
        for (std::size_t k = 0; k < inputs_.size(); ++k) {
            if (inputs_[k].plus >= 0) slopes.push_back({static_cast<std::size_t>(inputs_[k].plus), derivatives[k]});
            if (inputs_[k].minus >= 0) slopes.push_back({static_cast<std::size_t>(inputs_[k].minus), -derivatives[k]});
        }
        use(value, std::span<const Slope>(slopes));
    }

private:
    struct Input {
        int plus = -1, minus = -1;  // indices into the device's unknowns; -1: 0 V
        bool is_time = false;
        double constant = 0;  // of an input that is the temperature: degrees Celsius
        double value(std::span<const double> v, const EvalContext& context) const {
            if (is_time) return context.time;
            return (plus >= 0 ? v[static_cast<std::size_t>(plus)] : 0) - (minus >= 0 ? v[static_cast<std::size_t>(minus)] : 0) + constant;
        }
    };
    std::vector<Input> inputs_;
    std::vector<int> unknowns_;

    /// The index of an unknown of the system in unknowns_, to which it is added if necessary; -1: ground.
    int local_index(int unknown);
};

}  // namespace corpuscle::circuit
