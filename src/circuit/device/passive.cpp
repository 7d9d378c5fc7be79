#include "circuit/device/passive.hpp"

#include <array>

#include "circuit/device/constants.hpp"
#include "circuit/device/formula_inputs.hpp"
#include "circuit/device/values.hpp"

namespace corpuscle::circuit {
namespace {

/// Value times scale and 1 + tc1 dT + tc2 dT^2, dT from the model's tnom, that of .options, or 27 C.
double at_temperature(double value, const Element& e, const Setup& setup) {
    const Model* model = e.model < 0 ? nullptr : &setup.circuit().models[static_cast<std::size_t>(e.model)];
    const auto said = [&](std::string_view name, double otherwise) {
        return value_or(e.values, name, model ? value_or(model->values, name, otherwise) : otherwise);
    };
    const double dT = setup.temperature(e) - zero_celsius - said("tnom", value_or(setup.circuit().options, "tnom", 27));
    return value * value_or(e.values, "scale", 1) * (1 + said("tc1", 0) * dT + said("tc2", 0) * dT * dT);
}

constexpr std::string_view passive_values[] = {"m", "tc1", "tc2", "temp", "dtemp", "ic", "tnom", "scale"};
constexpr std::string_view model_values[] = {"tc1", "tc2", "tnom"};

/// What its line or its model says and is not read here.
std::optional<Error> unread(const Element& e, const Setup& setup) {
    if (auto wrong = unknown_value(e.name, e.values, passive_values, e.place)) return wrong;
    if (value_or(e.values, "scale", 1) == 0) return bad_input(fmt::format("{}: scale = 0 leaves nothing of it", e.name), e.place);
    if (e.model < 0) return {};
    const Model& model = setup.circuit().models[static_cast<std::size_t>(e.model)];
    return unknown_value(model.name, model.values, model_values, model.place);
}

/// i = v / R
class Resistor final : public Device {
    double g_, r_, kelvin_;

public:
    Resistor(double r, double m, double kelvin) : g_(m / r), r_(r / m), kelvin_(kelvin) {}
    void eval(std::span<const double> v, const Instant&, const Stamp& out) const override {
        const double i = g_ * (v[0] - v[1]);
        out.f[0] += i, out.f[1] -= i;
        out.slope(0, 0) += g_, out.slope(0, 1) -= g_, out.slope(1, 0) -= g_, out.slope(1, 1) += g_;
    }
    bool set(double r) override { return r != 0 && (g_ = 1 / r, r_ = r, true); }
    std::optional<double> setting() const override { return r_; }
    std::vector<NoiseSource> noise(std::span<const double>) const override { return {{"thermal", 0, 1, 4 * boltzmann * kelvin_ * g_, 0}}; }
    std::vector<Reading> readings(std::span<const double> v) const override {
        return {{"i", "A", g_ * (v[0] - v[1])}, {"p", "W", g_ * (v[0] - v[1]) * (v[0] - v[1])}};
    }
};

/// q = C v
class Capacitor final : public Device {
    double c_;

public:
    explicit Capacitor(double c) : c_(c) {}
    void eval(std::span<const double> v, const Instant&, const Stamp& out) const override {
        const double q = c_ * (v[0] - v[1]);
        out.q[0] += q, out.q[1] -= q;
        out.capacitance(0, 0) += c_, out.capacitance(0, 1) -= c_, out.capacitance(1, 0) -= c_, out.capacitance(1, 1) += c_;
    }
    bool set(double c) override { return c_ = c, true; }
    std::optional<double> setting() const override { return c_; }
};

/// q = a formula of voltages
class ChargeFormula final : public Device {
    Formula formula_;
    FormulaInputs inputs_;
    double m_;

public:
    ChargeFormula(Formula formula, FormulaInputs inputs, double m) : formula_(std::move(formula)), inputs_(std::move(inputs)), m_(m) {}
    bool linear() const override { return false; }
    void eval(std::span<const double> v, const Instant& at, const Stamp& out) const override {
        inputs_.eval(formula_, v, at, [&](double q, std::span<const FormulaInputs::Slope> slopes) {
            out.q[0] += m_ * q, out.q[1] -= m_ * q;
            for (const auto& s : slopes) out.capacitance(0, s.unknown) += m_ * s.value, out.capacitance(1, s.unknown) -= m_ * s.value;
        });
    }
};

/// v = L di/dt: the element's own unknown is its current, its own equation v - d(L i)/dt = 0
class Inductor final : public Device {
    double l_;

public:
    explicit Inductor(double l) : l_(l) {}
    void eval(std::span<const double> v, const Instant&, const Stamp& out) const override {
        out.f[0] += v[2], out.f[1] -= v[2];
        out.slope(0, 2) += 1, out.slope(1, 2) -= 1;
        out.f[2] += v[0] - v[1];
        out.slope(2, 0) += 1, out.slope(2, 1) -= 1;
        out.q[2] -= l_ * v[2];
        out.capacitance(2, 2) -= l_;
    }
    bool set(double l) override { return l_ = l, true; }
    std::optional<double> setting() const override { return l_; }
};

}  // namespace

Result<std::unique_ptr<Device>> make_resistor(const Element& e, Setup& setup) {
    if (auto wrong = unread(e, setup)) return *wrong;
    const double r = at_temperature(e.value, e, setup), m = value_or(e.values, "m", 1);
    if (r == 0) return bad_input(fmt::format("{}: a resistance of 0 ohm; a voltage source of 0 V is a wire", e.name), e.place);
    auto device = std::make_unique<Resistor>(r, m, setup.temperature(e));
    device->unknowns = {setup.node(e.nodes[0]), setup.node(e.nodes[1])};
    return std::unique_ptr<Device>(std::move(device));
}

Result<std::unique_ptr<Device>> make_capacitor(const Element& e, Setup& setup) {
    if (auto wrong = unread(e, setup)) return *wrong;
    const double m = value_or(e.values, "m", 1);
    for (const std::string_view name : {"scale", "tc1", "tc2"})
        if (e.formula && e.values.contains(name))
            return bad_input(fmt::format("{}: {} does not go with a formula of its charge; write it into q=", e.name, name), e.place);
    const std::vector<int> ends = {setup.node(e.nodes[0]), setup.node(e.nodes[1])};
    if (e.formula) {
        auto inputs = FormulaInputs::make(*e.formula, e, setup, ends);
        if (!inputs) return inputs.error();
        const auto unknowns = inputs->unknowns();
        auto device = std::make_unique<ChargeFormula>(*e.formula, std::move(*inputs), m);
        device->unknowns = unknowns;
        return std::unique_ptr<Device>(std::move(device));
    }
    auto device = std::make_unique<Capacitor>(at_temperature(e.value, e, setup) * m);
    device->unknowns = ends;
    return std::unique_ptr<Device>(std::move(device));
}

Result<std::unique_ptr<Device>> make_inductor(const Element& e, Setup& setup) {
    if (auto wrong = unread(e, setup)) return *wrong;
    auto device = std::make_unique<Inductor>(at_temperature(e.value, e, setup) / value_or(e.values, "m", 1));
    device->unknowns = {setup.node(e.nodes[0]), setup.node(e.nodes[1]), setup.branch(setup.circuit().element(e.name))};
    return std::unique_ptr<Device>(std::move(device));
}

}  // namespace corpuscle::circuit
