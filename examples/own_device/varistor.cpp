// A varistor, `y1 plus minus MODEL`: its current is a power of the voltage, and it has a capacitance.

#include <cmath>

#include "circuit/device/device_kind.hpp"
#include "circuit/device/named_values.hpp"
#include "circuit/export/element_text.hpp"
#include "circuit/netlist/element_reader.hpp"

namespace corpuscle::circuit {
namespace {

struct VaristorCard {
    double v0 = 10, i0 = 1e-3, alpha = 5, c = 0;
};

constexpr ParameterDef<VaristorCard> varistor_fields[] = {
    {"v0", &VaristorCard::v0, "V", 1e-3, 1e6, "voltage at which the current is i0"},
    {"i0", &VaristorCard::i0, "A", 1e-15, 1e3, "current at v0"},
    {"alpha", &VaristorCard::alpha, "", 1, 100, "exponent"},
    {"c", &VaristorCard::c, "F", 0, 1, "capacitance"},
};

/// Current and charge at the voltage v between the terminals:   i = i0 sign(v) |v / v0|^alpha,   q = c v
class Varistor final : public Device {
    VaristorCard c_;  // i0 and c of m varistors in parallel

    /// i / u at the voltage u.
    double conductance(double u) const { return c_.i0 / c_.v0 * std::pow(std::abs(u) / c_.v0, c_.alpha - 1); }

public:
    Varistor(const VaristorCard& card, double m) : c_(card) { c_.i0 *= m, c_.c *= m; }
    bool is_linear() const override { return false; }

    void eval(std::span<const double> v, const EvalContext&, const Stamp& out) const override {
        const double u = v[0] - v[1], g = conductance(u);
        Stamp::add_between(out.f, 0, 1, g * u), Stamp::add_between(out.q, 0, 1, c_.c * u);
        out.add_conductance(0, 1, c_.alpha * g), out.add_capacitance(0, 1, c_.c);
    }

    std::vector<OperatingValue> operating_info(std::span<const double> v) const override {
        const double u = v[0] - v[1];
        return {{"v", "V", u}, {"i", "A", conductance(u) * u}};
    }
};

/// Turns an element, with all its numbers evaluated, into a device.
Result<std::unique_ptr<Device>> make_varistor(const Element& e, DeviceSetup& setup) {
    const auto& model = setup.circuit().models[static_cast<std::size_t>(e.model)];
    const auto card = TRY(read_model_card<VaristorCard>(varistor_fields, model, {}));
    return make_device<Varistor>(setup.ends(e), card, value_or(e.values, "m", 1));
}

Result<void> read_varistor(ElementReader& line) {
    TRY(line.nodes(2, "plus, minus, then the model"));
    if (line.word_count() < 4) return line.error_at(3, "its model is missing");
    if (line.word_count() > 4) return line.too_many(4);
    return line.model(3, {"varistor"});
}

/// ngspice has no such device: a source with an expression, and a capacitor in parallel.
Result<std::string> write_varistor(const ElementExport& e) {
    const auto card = TRY(read_model_card<VaristorCard>(varistor_fields, *e.model(), {}));
    const auto plus = e.names.node(e.element.nodes[0]), minus = e.names.node(e.element.nodes[1]);
    const double m = e.value("m", 1);
    return fmt::format("{} i={}*sgn(v({},{}))*(abs(v({},{}))/{})^{}\nc_{} {} {} {}\n", e.head, m * card.i0, plus, minus, plus, minus,
                       card.v0, card.alpha, e.names.element(e.element.name), plus, minus, m * card.c);
}

constexpr ElementParameter varistor_parameters[] = {parameter_m};

}  // namespace

extern constexpr DeviceKind varistor_kind = {.letter = 'y',
                                             .description = "varistor",
                                             .read = read_varistor,
                                             .make = make_varistor,
                                             .parameters = varistor_parameters,
                                             .saves_terminal_current = true,
                                             .write_spice = write_varistor,
                                             .export_prefix = "b"};

}  // namespace corpuscle::circuit
