#include "circuit/netlist/formula.hpp"

#include <memory>

#include "circuit/netlist/formula_steps.hpp"

namespace corpuscle::circuit {
namespace {

/// Room for a number a step: on the stack for all but the longest formulas.
class Room {
    static constexpr std::size_t few = 64;
    double near_[few];
    std::unique_ptr<double[]> far_;
    double* at_;

public:
    explicit Room(std::size_t n) : far_(n > few ? new double[n] : nullptr), at_(far_ ? far_.get() : near_) {}
    double& operator[](std::size_t k) { return at_[k]; }
    double& operator[](std::int32_t k) { return at_[static_cast<std::size_t>(k)]; }
};

}  // namespace

/// What each step comes to; the last is the value.
template <class Values>
double Formula::run(std::span<const double> inputs, Values& values) const {
    for (std::size_t k = 0; k < steps_.size(); ++k) {
        const Step& s = steps_[k];
        const auto what = static_cast<Operation>(s.what);
        if (what == Operation::number)
            values[k] = s.number;
        else if (what == Operation::input)
            values[k] = inputs[static_cast<std::size_t>(s.a)];
        else
            values[k] = value_of(what, values[s.a], values[s.b], values[s.c]);
    }
    return steps_.empty() ? 0 : values[steps_.size() - 1];
}

double Formula::value(std::span<const double> inputs) const {
    Room values(steps_.size());
    return run(inputs, values);
}

/// The slopes by the reverse sweep: from the value back to what it came from, each step hands on what a change of it would do.
/// A step that does nothing for the value hands on nothing, even where its own slope is infinite.
double Formula::value(std::span<const double> inputs, std::span<double> slopes) const {
    Room values(steps_.size()), weight(steps_.size());
    const double value = run(inputs, values);
    std::fill(slopes.begin(), slopes.end(), 0.0);
    for (std::size_t k = 0; k < steps_.size(); ++k) weight[k] = 0;
    if (!steps_.empty()) weight[steps_.size() - 1] = 1;
    for (std::size_t k = steps_.size(); k-- > 0;) {
        const Step& s = steps_[k];
        const auto what = static_cast<Operation>(s.what);
        const double w = weight[k];
        if (w == 0 || what == Operation::number) continue;
        if (what == Operation::input) {
            slopes[static_cast<std::size_t>(s.a)] += w;
            continue;
        }
        const Slopes d = slopes_of(what, values[s.a], values[s.b], values[s.c], values[k]);
        const int n = operands(what);
        if (d.a != 0) weight[s.a] += w * d.a;
        if (n > 1 && d.b != 0) weight[s.b] += w * d.b;
        if (n > 2 && d.c != 0) weight[s.c] += w * d.c;
    }
    return value;
}

}  // namespace corpuscle::circuit
