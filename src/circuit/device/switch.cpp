// Switches: `s1 plus minus control+ control- MODEL [on|off]`, controlled by a voltage, and `w1 plus minus VSOURCE MODEL [on|off]`,
// controlled by the current through a voltage source.

#include <cmath>

#include "circuit/device/device_kind.hpp"
#include "circuit/device/named_values.hpp"
#include "circuit/device/physical_constants.hpp"
#include "circuit/export/element_text.hpp"
#include "circuit/netlist/element_reader.hpp"

namespace corpuscle::circuit {
namespace {

/// A model of type sw or csw. Levels are in V for S, in A for W.
struct HystereticCard {
    double threshold = 0, hysteresis = 0, ron = 1, roff = 1e12;
};

/// A model of type vswitch or iswitch.
struct SmoothCard {
    double on = 1, off = 0, ron = 1, roff = 1e6;
};

constexpr double max_level = 1e9, min_resistance = 1e-9, max_resistance = 1e18;

constexpr ParameterDef<HystereticCard> sw_fields[] = {
    {"vt", &HystereticCard::threshold, "V", -max_level, max_level, "threshold"},
    {"vh", &HystereticCard::hysteresis, "V", -max_level, max_level, "on above vt + vh, off below vt - vh; negative: a smooth transition"},
    {"ron", &HystereticCard::ron, "ohm", min_resistance, max_resistance, "resistance in the state on"},
    {"roff", &HystereticCard::roff, "ohm", min_resistance, max_resistance, "resistance in the state off"},
};
constexpr ParameterDef<HystereticCard> csw_fields[] = {
    {"it", &HystereticCard::threshold, "A", -max_level, max_level, "threshold"},
    {"ih", &HystereticCard::hysteresis, "A", -max_level, max_level, "on above it + ih, off below it - ih; negative: a smooth transition"},
    {"ron", &HystereticCard::ron, "ohm", min_resistance, max_resistance, "resistance in the state on"},
    {"roff", &HystereticCard::roff, "ohm", min_resistance, max_resistance, "resistance in the state off"},
};
constexpr ParameterDef<SmoothCard> vswitch_fields[] = {
    {"von", &SmoothCard::on, "V", -max_level, max_level, "voltage from which on the resistance is ron"},
    {"voff", &SmoothCard::off, "V", -max_level, max_level, "voltage from which on the resistance is roff"},
    {"ron", &SmoothCard::ron, "ohm", min_resistance, max_resistance, "resistance at von"},
    {"roff", &SmoothCard::roff, "ohm", min_resistance, max_resistance, "resistance at voff"},
};
constexpr ParameterDef<SmoothCard> iswitch_fields[] = {
    {"ion", &SmoothCard::on, "A", -max_level, max_level, "current from which on the resistance is ron"},
    {"ioff", &SmoothCard::off, "A", -max_level, max_level, "current from which on the resistance is roff"},
    {"ron", &SmoothCard::ron, "ohm", min_resistance, max_resistance, "resistance at ion"},
    {"roff", &SmoothCard::roff, "ohm", min_resistance, max_resistance, "resistance at ioff"},
};

/// .options tnom gives every model its tnom. Switches do not depend on it.
constexpr std::string_view other_names[] = {"tnom"};

/// A switch of either kind, with the numbers of its model.
struct SwitchLaw {
    bool is_smooth = false;
    double on = 0, off = 0;                     // V or A: on above `on`, off below `off`; between them the state is kept, or is smooth
    double g_on = 1, g_off = 1e-12, scale = 1;  // S, of all parallel switches; the control of one of them is scale * u
};

/// The conductance between two terminals. Unknowns: two nodes, then the controlling nodes or the controlling current.
class Switch : public Device {
protected:
    SwitchLaw law_;
    double kelvin_;

    double control(std::span<const double> v) const { return law_.scale * (v[2] - (v.size() > 3 ? v[3] : 0)); }
    virtual double conductance(double u) const = 0;  // S, at the control u

public:
    Switch(const SwitchLaw& law, double kelvin) : law_(law), kelvin_(kelvin) {}
    bool is_linear() const override { return false; }
    std::vector<NoiseSource> noise(std::span<const double> v) const override {
        return {{"thermal", 0, 1, 4 * boltzmann * kelvin_ * conductance(control(v)), 0}};
    }
    std::vector<OperatingValue> operating_info(std::span<const double> v) const override {
        const double g = conductance(control(v));
        return {{"control", v.size() > 3 ? "V" : "A", control(v)}, {"r", "ohm", 1 / g}, {"i", "A", g * (v[0] - v[1])}};
    }
    std::string operating_region(std::span<const double> v) const override {
        const double g = conductance(control(v));
        return g == law_.g_on ? "on" : g == law_.g_off ? "off" : "between";
    }
};

/// i = v / ron in the state on, v / roff in the state off. The state changes to on when the control rises above vt + vh, to off when it
/// falls below vt - vh.
class HystereticSwitch final : public Switch {
    bool initial_, is_on_ = initial_;

    double conductance(double) const override { return is_on_ ? law_.g_on : law_.g_off; }

public:
    HystereticSwitch(const SwitchLaw& law, double kelvin, bool initial) : Switch(law, kelvin), initial_(initial) {}
    void eval(std::span<const double> v, const EvalContext&, const Stamp& out) const override {
        const double g = conductance(0);
        Stamp::add_between(out.f, 0, 1, g * (v[0] - v[1]));
        out.add_conductance(0, 1, g);
    }
    std::optional<StateChange> next_change() const override {
        return StateChange{2, unknowns.size() > 3 ? std::optional<std::size_t>(3) : std::nullopt,
                           (is_on_ ? law_.off : law_.on) / law_.scale, !is_on_};
    }
    bool state() const override { return is_on_; }
    bool initial_state() const override { return initial_; }
    void set_state(bool on) override { is_on_ = on; }
};

/// The logarithm of the conductance is a cubic of the control u between `off` and `on`, with slope 0 at both ends (PSpice's reference
/// guide has the same law for ln r):
///
///     ln g = (ln g_on + ln g_off) / 2 + (ln g_on - ln g_off) (3/2 x - 2 x^3),   x = (u - (on + off) / 2) / (on - off),   -1/2 <= x <= 1/2
class SmoothSwitch final : public Switch {
    struct Law {
        double g, slope;  // S, S per V or A of the control
    };
    Law at(double u) const {
        const double width = law_.on - law_.off, x = (u - (law_.on + law_.off) / 2) / width, ratio = std::log(law_.g_on / law_.g_off);
        if (x >= 0.5) return {law_.g_on, 0};
        if (x <= -0.5) return {law_.g_off, 0};
        const double g = std::sqrt(law_.g_on * law_.g_off) * std::exp(ratio * (1.5 * x - 2 * x * x * x));
        return {g, g * ratio * (1.5 - 6 * x * x) / width};
    }
    double conductance(double u) const override { return at(u).g; }

public:
    using Switch::Switch;
    void eval(std::span<const double> v, const EvalContext&, const Stamp& out) const override {
        const auto [g, slope] = at(control(v));
        const double voltage = v[0] - v[1], by_control = law_.scale * slope * voltage;
        Stamp::add_between(out.f, 0, 1, g * voltage);
        out.add_conductance(0, 1, g);
        out.slope(0, 2) += by_control, out.slope(1, 2) -= by_control;
        if (v.size() > 3) out.slope(0, 3) -= by_control, out.slope(1, 3) += by_control;
    }
};

// ---- construction ----

SwitchLaw law_of(const HystereticCard& card) {
    const double h = card.hysteresis;
    return {h < 0, card.threshold + std::abs(h), card.threshold - std::abs(h), 1 / card.ron, 1 / card.roff};
}

Result<SwitchLaw> law_of(const SmoothCard& card, const Model& model) {
    if (card.on == card.off)
        return error_at(model.location, "{}: the levels for on and off are both {:g}; a model of type {} switches abruptly", model.name,
                        card.on, model.type == "vswitch" ? "sw" : "csw");
    return SwitchLaw{true, card.on, card.off, 1 / card.ron, 1 / card.roff};
}

/// The law of a switch that stands for m parallel ones.
Result<SwitchLaw> read_law(const Circuit& circuit, const Element& e) {
    const auto& model = *circuit.model_of(e);
    SwitchLaw law;
    if (model.type == "sw")
        law = law_of(TRY(read_model_card<HystereticCard>(sw_fields, model, other_names)));
    else if (model.type == "csw")
        law = law_of(TRY(read_model_card<HystereticCard>(csw_fields, model, other_names)));
    else if (model.type == "vswitch")
        law = TRY(law_of(TRY(read_model_card<SmoothCard>(vswitch_fields, model, other_names)), model));
    else
        law = TRY(law_of(TRY(read_model_card<SmoothCard>(iswitch_fields, model, other_names)), model));
    const double m = value_or(e.values, "m", 1);
    law.g_on *= m, law.g_off *= m, law.scale = e.value;
    return law;
}

Result<std::unique_ptr<Device>> make_switch(const Element& e, DeviceSetup& setup) {
    const auto law = TRY(read_law(setup.circuit(), e));
    std::vector<int> unknowns;
    for (const int node : e.nodes) unknowns.push_back(setup.node_unknown(node));
    if (!e.control_source.empty()) unknowns.push_back(setup.branch_unknown(setup.circuit().find_element(e.control_source)));
    if (law.is_smooth) return make_device<SmoothSwitch>(std::move(unknowns), law, setup.temperature(e));
    return make_device<HystereticSwitch>(std::move(unknowns), law, setup.temperature(e), value_or(e.values, "on", 0) != 0);
}

// ---- netlist ----

std::vector<std::string_view> model_names(std::string_view type) {
    if (type == "sw") return model_value_names(sw_fields, other_names);
    if (type == "csw") return model_value_names(csw_fields, other_names);
    return type == "vswitch" ? model_value_names(vswitch_fields, other_names) : model_value_names(iswitch_fields, other_names);
}

/// Reads the model and the words after it, of which the initial state is the only one.
Result<void> read_model_and_state(ElementReader& line, std::size_t word, std::initializer_list<std::string_view> types) {
    line.element.value = 1;
    if (word >= line.word_count()) return line.error_at(word, "its model is missing");
    TRY(line.model(word, types));
    line.drop_unknown_model_values(model_names(line.model_type()));
    for (++word; word < line.word_count(); ++word) {
        const auto text = line.text(word);
        if ((text != "on" && text != "off") || line.element.values.contains("on"))
            return line.error_at(word, "unexpected '{}'; after the model, only on or off may follow", text);
        line.element.values["on"] = text == "on";
    }
    return {};
}

Result<void> read_voltage_switch(ElementReader& line) {
    TRY(line.nodes(4, "plus, minus, the two controlling nodes, then the model"));
    return read_model_and_state(line, 5, {"sw", "vswitch"});
}

Result<void> read_current_switch(ElementReader& line) {
    TRY(line.nodes(2, "plus, minus, then the controlling voltage source and the model"));
    if (line.word_count() < 4) return line.error_at(3, "the controlling voltage source is missing");
    line.control_source(3);
    return read_model_and_state(line, 4, {"csw", "iswitch"});
}

/// The controlling current is that of all copies.
void multiply_current_switch(Element& e, double m) { multiply_m(e, m), e.value /= m; }

// ---- export ----

/// A smooth switch, as a source of its current.
std::string smooth_text(const ElementExport& e, const SwitchLaw& law) {
    const auto plus = e.names.node(e.element.nodes[0]), minus = e.names.node(e.element.nodes[1]);
    const auto control = e.element.control_source.empty()
                             ? fmt::format("v({},{})", e.names.node(e.element.nodes[2]), e.names.node(e.element.nodes[3]))
                             : fmt::format("i({})", e.names.element(e.element.control_source));
    const auto x = fmt::format("max(-0.5,min(0.5,({}*{}-({}))/({})))", law.scale, control, (law.on + law.off) / 2, law.on - law.off);
    return fmt::format("b_{} {} {} i='v({},{})*exp({}+({})*(1.5*{}-2*{}*{}*{}))'\n", e.names.element(e.element.name), plus, minus, plus,
                       minus, std::log(law.g_on * law.g_off) / 2, std::log(law.g_on / law.g_off), x, x, x, x);
}

/// The element and a model of its own, since ngspice's switches have no m.
Result<std::string> write_switch(const ElementExport& e) {
    const auto law = TRY(read_law(e.circuit, e.element));
    if (law.is_smooth) return smooth_text(e, law);
    const bool is_current = !e.element.control_source.empty();
    const auto model = e.names.element(e.element.name) + "_model";
    const auto control = is_current ? ' ' + e.names.element(e.element.control_source) : "";
    const char letter = is_current ? 'i' : 'v';
    return fmt::format("{}{} {} {}\n.model {} {}({}t={} {}h={} ron={} roff={})\n", e.head, control, model,
                       e.value("on", 0) != 0 ? "on" : "off", model, is_current ? "csw" : "sw", letter, (law.on + law.off) / 2 / law.scale,
                       letter, (law.on - law.off) / 2 / law.scale, 1 / law.g_on, 1 / law.g_off);
}

constexpr ElementParameter switch_parameters[] = {parameter_m, parameter_temp, parameter_dtemp};

}  // namespace

extern constexpr DeviceKind voltage_switch_kind = {.letter = 's',
                                                   .description = "switch controlled by a voltage",
                                                   .read = read_voltage_switch,
                                                   .make = make_switch,
                                                   .parameters = switch_parameters,
                                                   .saves_terminal_current = true,
                                                   .write_spice = write_switch};

extern constexpr DeviceKind current_switch_kind = {.letter = 'w',
                                                   .description = "switch controlled by a current",
                                                   .read = read_current_switch,
                                                   .make = make_switch,
                                                   .parameters = switch_parameters,
                                                   .multiply = multiply_current_switch,
                                                   .saves_terminal_current = true,
                                                   .write_spice = write_switch};

}  // namespace corpuscle::circuit
