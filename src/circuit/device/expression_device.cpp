#include "circuit/device/device_kind.hpp"

#include "circuit/device/named_values.hpp"
#include "circuit/device/physical_constants.hpp"

namespace corpuscle::circuit {
namespace {

/// An input of the expression: a difference of two of the device's unknowns, the time, or a constant.
struct DeviceInput {
    int plus = -1, minus = -1;  // indices into the device's unknowns; -1: 0 V
    bool is_time = false;
    double constant = 0;  // of an input that is the temperature: degrees Celsius

    double value(std::span<const double> v, const EvalContext& context) const {
        if (is_time) return context.time;
        return (plus >= 0 ? v[static_cast<std::size_t>(plus)] : 0) - (minus >= 0 ? v[static_cast<std::size_t>(minus)] : 0) + constant;
    }
};

/// i, q = m times an expression, or v(+) - v(-) = an expression. Unknowns: two nodes and, for a voltage, the current through the source;
/// then the other unknowns in the expression.
class ExpressionDevice final : public Device {
    Expression expression_;
    ExpressionQuantity quantity_;
    double m_;
    std::vector<DeviceInput> inputs_;
    bool has_jumps_ = expression_.has_jumps() && quantity_ != ExpressionQuantity::charge, has_poles_ = expression_.has_poles();

    /// The index of an unknown of the system in `unknowns`, to which it is added if necessary; -1: ground.
    int local_index(int unknown) {
        if (unknown < 0) return -1;
        const auto at = std::find(unknowns.begin(), unknowns.end(), unknown);
        if (at == unknowns.end()) unknowns.push_back(unknown);
        return static_cast<int>(std::find(unknowns.begin(), unknowns.end(), unknown) - unknowns.begin());
    }

    /// Adds a derivative of the expression's value with respect to one of the device's unknowns; -1: ground.
    void add_slope(const Stamp& out, const EvalContext& context, int unknown, double slope) const {
        if (unknown < 0) return;
        const auto u = static_cast<std::size_t>(unknown);
        if (quantity_ == ExpressionQuantity::voltage)
            out.slope(2, u) -= slope * context.source_scale;
        else if (quantity_ == ExpressionQuantity::current)
            out.slope(0, u) += m_ * slope * context.source_scale, out.slope(1, u) -= m_ * slope * context.source_scale;
        else
            out.capacitance(0, u) += m_ * slope, out.capacitance(1, u) -= m_ * slope;
    }

public:
    ExpressionDevice(const Expression& expression, ExpressionQuantity quantity, double m)
        : expression_(expression), quantity_(quantity), m_(m) {}
    bool is_linear() const override { return false; }
    bool has_jumps() const override { return has_jumps_; }

    /// Binds the inputs of the expression to unknowns. Call it when `unknowns` has the device's own.
    Result<void> bind(const Element& e, const DeviceSetup& setup) {
        for (const auto& in : expression_.inputs()) {
            DeviceInput input;
            if (in.kind == ExpressionInput::Kind::voltage) {
                const int plus = TRY(node(e, setup, in.name)), minus = in.minus.empty() ? -1 : TRY(node(e, setup, in.minus));
                input.plus = local_index(plus), input.minus = local_index(minus);
            } else if (in.kind == ExpressionInput::Kind::current) {
                const int unknown = setup.branch_unknown(setup.circuit().find_element(in.name));
                if (unknown < 0) return error_at(e.location, "{}: i({}): no voltage source or inductor has this name", e.name, in.name);
                input.plus = local_index(unknown);
            } else if (in.kind == ExpressionInput::Kind::time) {
                input.is_time = true;
            } else {
                input.constant = setup.temperature(e) - zero_celsius;
            }
            inputs_.push_back(input);
        }
        return {};
    }

    /// Newton's method begins at 0 V, where 1/v or ln(v) has no value. There the expression is evaluated a little beside, and continued
    /// along its tangent. Not if the expression has the time, which limit() does not know.
    bool limits() const override { return has_poles_ && std::ranges::none_of(inputs_, &DeviceInput::is_time); }
    bool limit(std::span<double> v, std::span<double>) const override {
        std::vector<double> values;
        const auto value_at = [&] {
            values.clear();
            for (const auto& in : inputs_) values.push_back(in.value(v, {}));
            return expression_.value(values);
        };
        if (std::isfinite(value_at())) return false;
        const std::vector<double> before(v.begin(), v.end());
        for (const double distance : {1e-6, -1e-6, 1e-3, -1e-3, 1.0, -1.0}) {
            double factor = 1;  // different for each input, so that differences change, too
            for (const auto& in : inputs_)
                if (in.plus >= 0)
                    v[static_cast<std::size_t>(in.plus)] = before[static_cast<std::size_t>(in.plus)] + factor * distance, factor *= 1.1;
            if (std::isfinite(value_at())) return true;
        }
        std::copy(before.begin(), before.end(), v.begin());
        return false;
    }

    void eval(std::span<const double> v, const EvalContext& context, const Stamp& out) const override {
        std::vector<double> values, slopes(inputs_.size());
        for (const auto& in : inputs_) values.push_back(in.value(v, context));
        const double value = expression_.value(values, slopes);
        if (has_poles_) replace_infinite_slopes(values, value, slopes);
        if (quantity_ == ExpressionQuantity::voltage)
            out.add_branch(v), out.f[2] -= value * context.source_scale;
        else if (quantity_ == ExpressionQuantity::current)
            Stamp::add_between(out.f, 0, 1, m_ * value * context.source_scale);
        else
            Stamp::add_between(out.q, 0, 1, m_ * value);
        for (std::size_t k = 0; k < inputs_.size(); ++k)
            add_slope(out, context, inputs_[k].plus, slopes[k]), add_slope(out, context, inputs_[k].minus, -slopes[k]);
    }

private:
    /// Replaces infinite slopes, as that of sqrt(v) at 0, by those of a chord.
    void replace_infinite_slopes(std::vector<double>& values, double value, std::span<double> slopes) const {
        for (std::size_t k = 0; k < slopes.size(); ++k) {
            if (std::isfinite(slopes[k]) || !std::isfinite(value)) continue;
            const double at = values[k], length = 1e-6 * std::max(1.0, std::abs(at));
            slopes[k] = 0;
            for (const double h : {length, -length}) {
                values[k] = at + h;
                const double slope = (expression_.value(values) - value) / h;
                if (std::isfinite(slope)) {
                    slopes[k] = slope;
                    break;
                }
            }
            values[k] = at;
        }
    }
    static Result<int> node(const Element& e, const DeviceSetup& setup, const std::string& name) {
        const Circuit& c = setup.circuit();
        const int number = c.find_node(name);
        if (number < 0) return error_at(e.location, "{}: unknown node '{}'{}", e.name, name, did_you_mean(name, c.nodes));
        return setup.node_unknown(number);
    }
};

}  // namespace

Result<std::unique_ptr<Device>> make_expression_device(const Element& e, DeviceSetup& setup, ExpressionQuantity quantity) {
    auto device = std::make_unique<ExpressionDevice>(*e.expression, quantity, value_or(e.values, "m", 1));
    device->unknowns = setup.ends(e);
    TRY(device->bind(e, setup));
    return std::unique_ptr<Device>(std::move(device));
}

}  // namespace corpuscle::circuit
