#include "varistor.hpp"

#include <cmath>

#include "circuit/device/named_values.hpp"

namespace corpuscle::circuit {
namespace {

struct VaristorCard {
    double v0 = 10, i0 = 1e-3, alpha = 5, c = 0;
};

constexpr ParameterDef<VaristorCard> fields[] = {
    {"v0", &VaristorCard::v0, "V", 1e-3, 1e6, "voltage at which the current is i0"},
    {"i0", &VaristorCard::i0, "A", 1e-15, 1e3, "current at v0"},
    {"alpha", &VaristorCard::alpha, "", 1, 100, "exponent"},
    {"c", &VaristorCard::c, "F", 0, 1, "capacitance"},
};

/// Current and charge at the voltage v between the terminals:   i = i0 sign(v) |v / v0|^alpha,   q = c v
class Varistor final : public Device {
    VaristorCard c_;

public:
    explicit Varistor(const VaristorCard& card) : c_(card) {}
    bool is_linear() const override { return false; }

    void eval(std::span<const double> v, const EvalContext&, const Stamp& out) const override {
        const double u = v[0] - v[1], x = std::abs(u) / c_.v0;
        const double g = c_.i0 / c_.v0 * std::pow(x, c_.alpha - 1);  // i / u
        const double i = g * u, di = c_.alpha * g;
        out.f[0] += i, out.f[1] -= i;
        out.slope(0, 0) += di, out.slope(0, 1) -= di, out.slope(1, 0) -= di, out.slope(1, 1) += di;
        out.q[0] += c_.c * u, out.q[1] -= c_.c * u;
        out.capacitance(0, 0) += c_.c, out.capacitance(0, 1) -= c_.c, out.capacitance(1, 0) -= c_.c, out.capacitance(1, 1) += c_.c;
    }

    std::vector<OperatingValue> operating_info(std::span<const double> v) const override {
        const double u = v[0] - v[1], g = c_.i0 / c_.v0 * std::pow(std::abs(u) / c_.v0, c_.alpha - 1);
        return {{"v", "V", u}, {"i", "A", g * u}};
    }
};

}  // namespace

Result<std::unique_ptr<Device>> make_varistor(const Element& e, DeviceSetup& setup) {
    TRY(check_value_names(e.name, e.values, {}, e.location));
    const auto card = TRY(read_model_card<VaristorCard>(fields, setup.circuit().models[static_cast<std::size_t>(e.model)], {}));
    auto device = std::make_unique<Varistor>(card);
    device->unknowns = {setup.node_unknown(e.nodes[0]), setup.node_unknown(e.nodes[1])};
    return std::unique_ptr<Device>(std::move(device));
}

}  // namespace corpuscle::circuit
