#pragma once
// What a formula of an element is worked out from: which of the device's unknowns its voltages and currents are.

#include "circuit/device/device.hpp"

namespace corpuscle::circuit {

class FormulaInputs {
public:
    /// How the value changes with one of the device's unknowns.
    struct Slope {
        std::size_t unknown;
        double value;
    };

    /// `first`: the unknowns that the device has whatever its formula says; those of the formula come after.
    static Result<FormulaInputs> make(const Formula&, const Element&, const Setup&, std::vector<int> first);

    const std::vector<int>& unknowns() const { return unknowns_; }

    /// Calls use(value, slopes).
    template <class Use>
    void eval(const Formula& formula, std::span<const double> v, const Instant& at, const Use& use) const {
        std::vector<double> values, by(inputs_.size());
        for (const auto& in : inputs_) values.push_back(in.of(v, at));
        const double value = formula.value(values, by);
        std::vector<Slope> slopes;
        for (std::size_t k = 0; k < inputs_.size(); ++k) {
            if (inputs_[k].plus >= 0) slopes.push_back({static_cast<std::size_t>(inputs_[k].plus), by[k]});
            if (inputs_[k].minus >= 0) slopes.push_back({static_cast<std::size_t>(inputs_[k].minus), -by[k]});
        }
        use(value, std::span<const Slope>(slopes));
    }

private:
    struct Input {
        int plus = -1, minus = -1;  // of the device's unknowns; -1: 0
        bool is_time = false;
        double constant = 0;  // temperature
        double of(std::span<const double> v, const Instant& at) const {
            if (is_time) return at.time;
            return (plus >= 0 ? v[static_cast<std::size_t>(plus)] : 0) - (minus >= 0 ? v[static_cast<std::size_t>(minus)] : 0) + constant;
        }
    };
    std::vector<Input> inputs_;
    std::vector<int> unknowns_;

    int local(int unknown);
};

}  // namespace corpuscle::circuit
