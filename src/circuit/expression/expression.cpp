#include "circuit/expression/expression.hpp"

#include <algorithm>
#include <memory>

#include "circuit/expression/expression_operations.hpp"

namespace corpuscle::circuit {
namespace {

/// A buffer with a number for each step, on the stack for all but the longest expressions.
class StepBuffer {
    static constexpr std::size_t max_on_stack = 64;
    double on_stack_[max_on_stack];
    std::unique_ptr<double[]> on_heap_;
    double* data_;

public:
    explicit StepBuffer(std::size_t n)
        : on_heap_(n > max_on_stack ? new double[n] : nullptr), data_(on_heap_ ? on_heap_.get() : on_stack_) {}
    double& operator[](std::size_t k) { return data_[k]; }
    double& operator[](std::int32_t k) { return data_[static_cast<std::size_t>(k)]; }
};

}  // namespace

/// Evaluates all steps into `values` and returns the value of the last one.
template <class Values>
double Expression::evaluate(std::span<const double> inputs, Values& values) const {
    for (std::size_t k = 0; k < steps_.size(); ++k) {
        const Step& s = steps_[k];
        if (s.operation)
            values[k] = s.operation->value({values[s.a], values[s.b], values[s.c]});
        else
            values[k] = s.is_number() ? s.number : inputs[static_cast<std::size_t>(s.input)];
    }
    return steps_.empty() ? 0 : values[steps_.size() - 1];
}

bool Expression::has_jumps() const {
    return std::any_of(steps_.begin(), steps_.end(), [](const Step& s) { return s.operation && s.operation->has_jumps(); });
}

double Expression::value(std::span<const double> inputs) const {
    StepBuffer values(steps_.size());
    return evaluate(inputs, values);
}

/// Computes derivatives by reverse accumulation. The weight of a step is the derivative of the expression's value with respect to the
/// step's value. From the last step back to the inputs, each step adds its weight times its own derivatives to the weights of its operands.
/// A step with weight 0 adds nothing, even where its own derivative is infinite.
double Expression::value(std::span<const double> inputs, std::span<double> slopes) const {
    StepBuffer values(steps_.size()), weight(steps_.size());
    const double value = evaluate(inputs, values);
    std::fill(slopes.begin(), slopes.end(), 0.0);
    for (std::size_t k = 0; k < steps_.size(); ++k) weight[k] = 0;
    if (!steps_.empty()) weight[steps_.size() - 1] = 1;
    for (std::size_t k = steps_.size(); k-- > 0;) {
        const Step& s = steps_[k];
        const double w = weight[k];
        if (w == 0) continue;
        if (s.input >= 0) slopes[static_cast<std::size_t>(s.input)] += w;
        if (!s.operation || !s.operation->slopes) continue;
        const Slopes d = s.operation->slopes({values[s.a], values[s.b], values[s.c], values[k]});
        if (d.a != 0) weight[s.a] += w * d.a;
        if (d.b != 0) weight[s.b] += w * d.b;
        if (d.c != 0) weight[s.c] += w * d.c;
    }
    return value;
}

}  // namespace corpuscle::circuit
