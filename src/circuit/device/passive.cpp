// Resistor, capacitor, inductor.

#include "circuit/device/device_kind.hpp"
#include "circuit/device/named_values.hpp"
#include "circuit/device/physical_constants.hpp"
#include "circuit/export/element_text.hpp"
#include "circuit/expression/spice_number.hpp"
#include "circuit/netlist/element_reader.hpp"

namespace corpuscle::circuit {
namespace {

/// The value of an R, C or L at its temperature: value * scale * (1 + tc1 dT + tc2 dT^2), where dT is the temperature above tnom. The
/// values of tc1, tc2 and tnom are those of the element, else of its model. The default of tnom is that of .options, else 27 C.
double at_temperature(double value, const Element& e, const DeviceSetup& setup) {
    const auto parameter = [&](std::string_view name, double fallback) { return value_or_of_model(setup.circuit(), e, name, fallback); };
    const double dT = setup.temperature(e) - zero_celsius - parameter("tnom", value_or(setup.circuit().options, "tnom", 27));
    return value * value_or(e.values, "scale", 1) * (1 + parameter("tc1", 0) * dT + parameter("tc2", 0) * dT * dT);
}

constexpr std::string_view model_values[] = {"tc1",   "tc2", "tnom", "rsh", "r",   "res", "defw", "defl", "narrow",
                                             "short", "cj",  "cjsw", "c",   "cap", "ind", "l",    "kf",   "af"};

/// Rejects a scale of 0, and parameters that the model of a resistor, capacitor or inductor does not have.
Result<void> check_parameters(const Element& e, const DeviceSetup& setup) {
    for (const std::string_view noise : {"kf"})
        if (const auto* m = setup.circuit().model_of(e); m && value_or(m->values, noise, 0) != 0)
            return error_at(m->location, "{}: {} (flicker noise of a resistor) is not supported", m->name, noise);
    if (value_or(e.values, "scale", 1) == 0) return error_at(e.location, "{}: scale must not be 0", e.name);
    const Model* model = setup.circuit().model_of(e);
    return model ? check_value_names(model->name, model->values, model_values, model->location) : Result<void>();
}

/// i = v / R. Unknowns: two nodes.
class Resistor final : public DeviceWithValue {
    double g_, kelvin_;  // S, of m resistors in parallel; K
    bool is_noisy_;

public:
    Resistor(double r, double m, double kelvin, bool is_noisy) : DeviceWithValue(r / m), g_(m / r), kelvin_(kelvin), is_noisy_(is_noisy) {}
    void eval(std::span<const double> v, const EvalContext&, const Stamp& out) const override {
        Stamp::add_between(out.f, 0, 1, g_ * (v[0] - v[1]));
        out.add_conductance(0, 1, g_);
    }
    bool set_principal_value(double r) override { return r != 0 && (g_ = 1 / r, value_ = r, true); }
    std::vector<NoiseSource> noise(std::span<const double>) const override {
        return is_noisy_ ? std::vector<NoiseSource>{{"thermal", 0, 1, 4 * boltzmann * kelvin_ * g_, 0}} : std::vector<NoiseSource>();
    }
    std::vector<OperatingValue> operating_info(std::span<const double> v) const override {
        return {{"i", "A", g_ * (v[0] - v[1])}, {"p", "W", g_ * (v[0] - v[1]) * (v[0] - v[1])}};
    }
};

/// q = C v. Unknowns: two nodes.
class Capacitor final : public DeviceWithValue {
public:
    using DeviceWithValue::DeviceWithValue;
    void eval(std::span<const double> v, const EvalContext&, const Stamp& out) const override {
        Stamp::add_between(out.q, 0, 1, value_ * (v[0] - v[1]));
        out.add_capacitance(0, 1, value_);
    }
};

/// v = R i + L di/dt. Unknowns: two nodes, and the current; the equation of the current is v - R i - d(L i)/dt = 0.
class Inductor final : public DeviceWithValue {
    double resistance_;  // ohm

public:
    Inductor(double inductance, double resistance) : DeviceWithValue(inductance), resistance_(resistance) {}
    void eval(std::span<const double> v, const EvalContext&, const Stamp& out) const override {
        out.add_branch(v);
        out.f[2] -= resistance_ * v[2];
        out.slope(2, 2) -= resistance_;
        out.q[2] -= value_ * v[2];
        out.capacitance(2, 2) -= value_;
    }
};

Result<std::unique_ptr<Device>> make_resistor(const Element& e, DeviceSetup& setup) {
    TRY(check_parameters(e, setup));
    if (e.expression) return make_expression_device(e, setup, ExpressionQuantity::current);
    const double r = at_temperature(e.value, e, setup), m = value_or(e.values, "m", 1);
    if (r == 0) return error_at(e.location, "{}: 0 ohm is not allowed; use a voltage source of 0 V as a wire", e.name);
    return make_device<Resistor>(setup.ends(e), r, m, setup.temperature(e), value_or(e.values, "noisy", 1) != 0);
}

Result<std::unique_ptr<Device>> make_capacitor(const Element& e, DeviceSetup& setup) {
    TRY(check_parameters(e, setup));
    for (const std::string_view name : {"scale", "tc1", "tc2"})
        if (e.expression && e.values.contains(name))
            return error_at(e.location, "{}: {} has no effect on a charge expression; put it into q=", e.name, name);
    if (e.expression) return make_expression_device(e, setup, ExpressionQuantity::charge);
    return make_device<Capacitor>(setup.ends(e), at_temperature(e.value, e, setup) * value_or(e.values, "m", 1));
}

Result<std::unique_ptr<Device>> make_inductor(const Element& e, DeviceSetup& setup) {
    TRY(check_parameters(e, setup));
    const double m = value_or(e.values, "m", 1), resistance = value_or(e.values, "rser", 0) / m;
    if (!(resistance >= 0)) return error_at(e.location, "{}: rser = {:g} ohm is below 0", e.name, resistance * m);
    return make_device<Inductor>(setup.ends(e), at_temperature(e.value, e, setup) / m, resistance);
}

// ---- netlist ----

/// True if a word after the nodes names a model; otherwise it is the value. A word that is neither a number, an expression nor the name of
/// a parameter names a model. After the value, the name of a parameter does, too.
bool names_model(const ElementReader& line, std::size_t word, bool has_value) {
    const auto text = line.text(word);
    if (!line.is_plain(word) || parse_number(text)) return false;
    if (line.is_model(word)) return true;
    const bool begins_with_letter = text[0] >= 'a' && text[0] <= 'z';
    return begins_with_letter && (has_value || (!line.is_parameter(word) && text.find_first_of("*/+-") == std::string_view::npos));
}

/// A length or width of the line (m), else of its model, else 10 um, less what the process takes away at its edges; as in SPICE.
Result<double> dimension(ElementReader& line, std::string_view name, std::string_view model_name, std::string_view reduction) {
    const auto* pair = line.find(name);
    const double drawn = pair ? TRY(line.number(*pair)) : line.model_value(model_name).value_or(10e-6);
    const double left = drawn - line.model_value(reduction).value_or(0);
    if (!(left > 0))
        return line.error_at(pair ? pair->value : line.word(0), "{} = {:g} m leaves nothing of its length or width", name, left);
    return left;
}

/// The value of an element from its model: a value there, or that of a sheet of the length l and the width w. nullopt: none.
Result<std::optional<double>> value_of_model(ElementReader& line) {
    const auto first_of = [&](std::initializer_list<std::string_view> names) -> std::optional<double> {
        for (const auto name : names)
            if (const auto value = line.model_value(name)) return value;
        return {};
    };
    const char letter = line.element.letter;
    if (letter == 'l') return first_of({"ind", "l"});
    const auto sheet =
        first_of(letter == 'r' ? std::initializer_list<std::string_view>{"rsh"} : std::initializer_list<std::string_view>{"cj", "cjsw"});
    if (!sheet || *sheet == 0) return letter == 'r' ? first_of({"r", "res"}) : first_of({"cap", "c"});
    const double l = TRY(dimension(line, "l", "defl", "short")), w = TRY(dimension(line, "w", "defw", "narrow"));
    if (letter == 'r') return std::optional(*sheet * l / w);
    return std::optional(line.model_value("cj").value_or(0) * l * w + 2 * line.model_value("cjsw").value_or(0) * (l + w));
}

/// True if a value depends on voltages, currents or the time.
bool depends_on_solution(std::string_view text) {
    const auto is_in_name = [&](std::size_t k) {
        return k < text.size() && (std::isalnum(static_cast<unsigned char>(text[k])) || text[k] == '_');
    };
    for (const std::string_view word : {"v(", "i(", "time"})
        for (auto at = text.find(word); at != text.npos; at = text.find(word, at + 1)) {
            const bool begins_name = at == 0 || !is_in_name(at - 1), ends_name = word.back() == '(' || !is_in_name(at + word.size());
            if (begins_name && ends_name) return true;
        }
    return false;
}

/// Reads a word, or the value of a pair, as the value. A resistance that depends on the solution becomes an expression of the current.
Result<void> read_passive_value(ElementReader& line, const Word& word, std::string_view text) {
    if (line.element.letter != 'r' || word.kind != Word::Kind::expression || !depends_on_solution(text)) return line.value(word);
    return line.expression(fmt::format("v({},{})/({})", line.text(1), line.text(2), text), word);
}

/// Reads tc=TC1[,TC2] of LTspice and HSPICE. Returns the number of words before TC2.
Result<std::size_t> read_temperature_coefficients(ElementReader& line) {
    const auto* tc = line.find("tc");
    const auto last = line.word_count() - 1;
    if (tc == nullptr) return last + 1;
    line.element.values["tc1"] = TRY(line.number(*tc));
    if (line.word(last).at < tc->value.at) return last + 1;
    line.element.values["tc2"] = TRY(line.number(last));
    return last;
}

/// Reads nodes, then a model or a value or both. The value may be given as r=, c= or l=, and that of a capacitor as a charge q=.
Result<void> read_passive(ElementReader& line) {
    TRY(line.nodes(2, "plus, minus, then a value or a model"));
    Element& e = line.element;
    const std::string_view letter(&e.letter, 1);
    bool has_value = false;
    const auto words = TRY(read_temperature_coefficients(line));
    for (std::size_t k = 3; k < words; ++k) {
        const bool is_name = names_model(line, k, has_value);
        if (is_name ? e.model >= 0 : has_value) return line.too_many(k);
        TRY(is_name ? line.model(k, {letter}) : read_passive_value(line, line.word(k), line.text(k)));
        has_value = has_value || !is_name;
    }
    if (e.model >= 0) line.drop_unknown_model_values(model_values);
    if (const auto* pair = line.find(letter)) {
        if (has_value) return line.error_at(pair->name, "its value is given twice");
        line.take(*pair);
        TRY(read_passive_value(line, pair->value, line.text(*pair)));
        has_value = true;
    }
    if (const auto* q = e.letter == 'c' ? line.find("q") : nullptr) {
        if (has_value) return line.error_at(q->name, "has both a capacitance and a charge");
        return line.expression(*q);
    }
    const auto computed = has_value || e.model < 0 ? std::nullopt : TRY(value_of_model(line));
    if (computed) e.value = *computed;
    if (!has_value && !computed)
        return line.error_at(line.word_count(), "its value is missing{}", e.model < 0 ? "" : "; its model does not give one either");
    if (e.letter == 'r' && e.value == 0 && !e.expression) {
        constexpr double wire = 1e-3;  // ohm, as in ngspice
        line.warn(3, fmt::format("0 ohm is taken as {:g} ohm; a 0 V source connects two nodes exactly", wire));
        e.value = wire;
    }
    return {};
}

// ---- export ----

/// True if .dc sweeps the element.
bool is_swept(const ElementExport& e) {
    return std::ranges::any_of(e.circuit.directives_named("dc"), [&](const Directive& c) {
        return std::find(c.words.begin(), c.words.end(), e.element.name) != c.words.end();
    });
}

/// A source of the current of a resistor whose resistance depends on the solution.
Result<std::string> write_resistance_expression(const ElementExport& e) {
    const auto current = TRY(e.expression());
    return fmt::format("b_{} {} {} i='{}'\n", e.names.element(e.element.name), e.names.node(e.element.nodes[0]),
                       e.names.node(e.element.nodes[1]), current);
}

/// An R, C or L; m parallel ones are merged into one. An element that .dc sweeps is written with its value at its temperature and without
/// temperature coefficients, because ngspice would apply these to each value of the sweep.
Result<std::string> write_passive(const ElementExport& e) {
    if (e.element.expression && e.element.letter == 'r') return write_resistance_expression(e);
    if (e.element.expression) {
        const auto charge = TRY(e.expression());
        return fmt::format("{} q='{}'\n", e.head, charge);
    }
    const double m = e.value("m", 1), scaled = e.element.value * e.value("scale", 1),
                 total = e.element.letter == 'c' ? scaled * m : scaled / m;
    const auto parameter = [&](std::string_view name, double fallback) { return value_or_of_model(e.circuit, e.element, name, fallback); };
    const double tc1 = parameter("tc1", 0), tc2 = parameter("tc2", 0),
                 dT = celsius_of(e.circuit, e.element) - parameter("tnom", value_or(e.circuit.options, "tnom", 27));
    if (is_swept(e)) return fmt::format("{} {}{}\n", e.head, total * (1 + tc1 * dT + tc2 * dT * dT), e.temperature());
    std::string head = e.head, series;
    if (const double resistance = e.value("rser", 0) / m; resistance > 0) {
        const auto name = e.names.element(e.element.name), inner = name + "_rser";
        head = fmt::format("{} {} {}", name, e.names.node(e.element.nodes[0]), inner);
        series = fmt::format("r_{} {} {} {}\n", inner, inner, e.names.node(e.element.nodes[1]), resistance);
    }
    std::string out = fmt::format("{} {}", head, total);
    if (e.model() && e.model()->values.contains("tnom")) out += ' ' + e.names.model(e.element.model);
    if (tc1 != 0 || tc2 != 0) out += fmt::format(" tc1={} tc2={}", tc1, tc2);
    if (e.element.values.contains("ic")) out += fmt::format(" ic={}", e.value("ic", 0));
    if (e.value("noisy", 1) == 0) out += " noisy=0";
    return out + e.temperature() + '\n' + series;
}

// ---- rows ----

/// The plates of a linear capacitor. The area of an expression is not known.
std::optional<Area> capacitor_area(const Element& e) {
    if (e.expression) return {};
    Area out;
    out.capacitors = std::abs(e.value) * value_or(e.values, "m", 1) / capacitor_density;
    return out;
}

constexpr ElementParameter parameter_tc1{"tc1", ""}, parameter_tc2{"tc2", ""};
constexpr ElementParameter parallel_capacitors{"m", "", above_zero, unlimited, 1, false, true};

constexpr ElementParameter resistor_parameters[] = {{.name = "r", .unit = "ohm", .is_value = true, .excludes_zero = true},
                                                    parameter_m,
                                                    parameter_tc1,
                                                    parameter_tc2,
                                                    parameter_temp,
                                                    parameter_dtemp};
constexpr ElementParameter capacitor_parameters[] = {{.name = "c", .unit = "F", .low = 0, .is_value = true},
                                                     parallel_capacitors,
                                                     parameter_tc1,
                                                     parameter_tc2,
                                                     parameter_temp,
                                                     parameter_dtemp};
constexpr ElementParameter inductor_parameters[] = {
    {.name = "l", .unit = "H", .low = 0, .is_value = true}, parameter_m, parameter_tc1, parameter_tc2, parameter_temp, parameter_dtemp};
constexpr std::string_view resistor_names[] = {"scale", "l", "w", "noisy"},
                           capacitor_names[] = {"q", "ic", "scale", "l", "w", "rser", "lser", "rpar", "cpar"},
                           inductor_names[] = {"ic", "scale", "rser", "rpar", "cpar"}, charge_names[] = {"q"};

}  // namespace

extern constexpr DeviceKind resistor_kind = {.letter = 'r',
                                             .description = "resistor",
                                             .read = read_passive,
                                             .make = make_resistor,
                                             .parameters = resistor_parameters,
                                             .other_names = resistor_names,
                                             .saves_terminal_current = true,
                                             .write_spice = write_passive};

extern constexpr DeviceKind capacitor_kind = {.letter = 'c',
                                              .description = "capacitor, linear or with an expression for its charge",
                                              .role = Role::capacitor,
                                              .read = read_passive,
                                              .make = make_capacitor,
                                              .parameters = capacitor_parameters,
                                              .other_names = capacitor_names,
                                              .expression_names = charge_names,
                                              .conducting_nodes = no_nodes,
                                              .area = capacitor_area,
                                              .write_spice = write_passive};

extern constexpr DeviceKind inductor_kind = {.letter = 'l',
                                             .description = "inductor",
                                             .role = Role::inductor,
                                             .read = read_passive,
                                             .make = make_inductor,
                                             .parameters = inductor_parameters,
                                             .other_names = inductor_names,
                                             .has_branch_current = always,
                                             .write_spice = write_passive};

}  // namespace corpuscle::circuit
