#include "circuit/device/passive.hpp"

#include <array>

#include "circuit/device/expression_binding.hpp"
#include "circuit/device/named_values.hpp"
#include "circuit/device/physical_constants.hpp"

namespace corpuscle::circuit {
namespace {

/// The value of an R, C or L at its temperature: value * scale * (1 + tc1 dT + tc2 dT^2), where dT is the temperature above tnom. The
/// values of tc1, tc2 and tnom are those of the element, else of its model. The default of tnom is that of .options, else 27 C.
double at_temperature(double value, const Element& e, const DeviceSetup& setup) {
    const Model* model = e.model < 0 ? nullptr : &setup.circuit().models[static_cast<std::size_t>(e.model)];
    const auto parameter = [&](std::string_view name, double fallback) {
        return value_or(e.values, name, model ? value_or(model->values, name, fallback) : fallback);
    };
    const double dT = setup.temperature(e) - zero_celsius - parameter("tnom", value_or(setup.circuit().options, "tnom", 27));
    return value * value_or(e.values, "scale", 1) * (1 + parameter("tc1", 0) * dT + parameter("tc2", 0) * dT * dT);
}

constexpr std::string_view passive_values[] = {"m", "tc1", "tc2", "temp", "dtemp", "ic", "tnom", "scale"};
constexpr std::string_view model_values[] = {"tc1", "tc2", "tnom"};

/// Rejects parameters that a resistor, capacitor or inductor, or its model, does not have.
Result<void> check_parameters(const Element& e, const DeviceSetup& setup) {
    TRY(check_value_names(e.name, e.values, passive_values, e.location));
    if (value_or(e.values, "scale", 1) == 0) return bad_input(fmt::format("{}: scale must not be 0", e.name), e.location);
    if (e.model < 0) return {};
    const Model& model = setup.circuit().models[static_cast<std::size_t>(e.model)];
    return check_value_names(model.name, model.values, model_values, model.location);
}

/// i = v / R. Unknowns: two nodes.
class Resistor final : public Device {
    double g_, r_, kelvin_;  // S and ohm of m resistors in parallel; K

public:
    Resistor(double r, double m, double kelvin) : g_(m / r), r_(r / m), kelvin_(kelvin) {}
    void eval(std::span<const double> v, const EvalContext&, const Stamp& out) const override {
        const double i = g_ * (v[0] - v[1]);
        out.f[0] += i, out.f[1] -= i;
        out.slope(0, 0) += g_, out.slope(0, 1) -= g_, out.slope(1, 0) -= g_, out.slope(1, 1) += g_;
    }
    bool set_principal_value(double r) override { return r != 0 && (g_ = 1 / r, r_ = r, true); }
    std::optional<double> principal_value() const override { return r_; }
    std::vector<NoiseSource> noise(std::span<const double>) const override { return {{"thermal", 0, 1, 4 * boltzmann * kelvin_ * g_, 0}}; }
    std::vector<OperatingValue> operating_info(std::span<const double> v) const override {
        return {{"i", "A", g_ * (v[0] - v[1])}, {"p", "W", g_ * (v[0] - v[1]) * (v[0] - v[1])}};
    }
};

/// q = C v. Unknowns: two nodes.
class Capacitor final : public Device {
    double c_;

public:
    explicit Capacitor(double c) : c_(c) {}
    void eval(std::span<const double> v, const EvalContext&, const Stamp& out) const override {
        const double q = c_ * (v[0] - v[1]);
        out.q[0] += q, out.q[1] -= q;
        out.capacitance(0, 0) += c_, out.capacitance(0, 1) -= c_, out.capacitance(1, 0) -= c_, out.capacitance(1, 1) += c_;
    }
    bool set_principal_value(double c) override { return c_ = c, true; }
    std::optional<double> principal_value() const override { return c_; }
};

/// q = m times an expression. Unknowns: two nodes, then those that only the expression uses.
class ChargeExpression final : public Device {
    Expression expression_;
    ExpressionBinding binding_;
    double m_;

public:
    ChargeExpression(Expression expression, ExpressionBinding binding, double m)
        : expression_(std::move(expression)), binding_(std::move(binding)), m_(m) {}
    bool is_linear() const override { return false; }
    void eval(std::span<const double> v, const EvalContext& context, const Stamp& out) const override {
        binding_.eval(expression_, v, context, [&](double q, std::span<const ExpressionBinding::Slope> slopes) {
            out.q[0] += m_ * q, out.q[1] -= m_ * q;
            for (const auto& s : slopes) out.capacitance(0, s.unknown) += m_ * s.value, out.capacitance(1, s.unknown) -= m_ * s.value;
        });
    }
};

/// v = L di/dt. Unknowns: two nodes, and the current; the equation of the current is v - d(L i)/dt = 0.
class Inductor final : public Device {
    double l_;

public:
    explicit Inductor(double l) : l_(l) {}
    void eval(std::span<const double> v, const EvalContext&, const Stamp& out) const override {
        out.f[0] += v[2], out.f[1] -= v[2];
        out.slope(0, 2) += 1, out.slope(1, 2) -= 1;
        out.f[2] += v[0] - v[1];
        out.slope(2, 0) += 1, out.slope(2, 1) -= 1;
        out.q[2] -= l_ * v[2];
        out.capacitance(2, 2) -= l_;
    }
    bool set_principal_value(double l) override { return l_ = l, true; }
    std::optional<double> principal_value() const override { return l_; }
};

}  // namespace

Result<std::unique_ptr<Device>> make_resistor(const Element& e, DeviceSetup& setup) {
    TRY(check_parameters(e, setup));
    const double r = at_temperature(e.value, e, setup), m = value_or(e.values, "m", 1);
    if (r == 0) return bad_input(fmt::format("{}: 0 ohm is not allowed; use a voltage source of 0 V as a wire", e.name), e.location);
    auto device = std::make_unique<Resistor>(r, m, setup.temperature(e));
    device->unknowns = {setup.node_unknown(e.nodes[0]), setup.node_unknown(e.nodes[1])};
    return std::unique_ptr<Device>(std::move(device));
}

Result<std::unique_ptr<Device>> make_capacitor(const Element& e, DeviceSetup& setup) {
    TRY(check_parameters(e, setup));
    const double m = value_or(e.values, "m", 1);
    for (const std::string_view name : {"scale", "tc1", "tc2"})
        if (e.expression && e.values.contains(name))
            return bad_input(fmt::format("{}: {} has no effect on a charge expression; put it into q=", e.name, name), e.location);
    const std::vector<int> ends = {setup.node_unknown(e.nodes[0]), setup.node_unknown(e.nodes[1])};
    if (e.expression) {
        auto binding = TRY(ExpressionBinding::make(*e.expression, e, setup, ends));
        const auto unknowns = binding.unknowns();
        auto device = std::make_unique<ChargeExpression>(*e.expression, std::move(binding), m);
        device->unknowns = unknowns;
        return std::unique_ptr<Device>(std::move(device));
    }
    auto device = std::make_unique<Capacitor>(at_temperature(e.value, e, setup) * m);
    device->unknowns = ends;
    return std::unique_ptr<Device>(std::move(device));
}

Result<std::unique_ptr<Device>> make_inductor(const Element& e, DeviceSetup& setup) {
    TRY(check_parameters(e, setup));
    auto device = std::make_unique<Inductor>(at_temperature(e.value, e, setup) / value_or(e.values, "m", 1));
    device->unknowns = {setup.node_unknown(e.nodes[0]), setup.node_unknown(e.nodes[1]),
                        setup.branch_unknown(setup.circuit().find_element(e.name))};
    return std::unique_ptr<Device>(std::move(device));
}

}  // namespace corpuscle::circuit
