#include "circuit/schematic/level/part_of_element.hpp"

#include "circuit/device/named_values.hpp"
#include "circuit/devices.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle::circuit::schematic {
namespace {

constexpr std::size_t max_sense_pins = 3;  // of an expression; with more, its text alone tells them

Symbol symbol_of(const Circuit& circuit, const Element& e) {
    const auto* model = circuit.model_of(e);
    const bool is_p = model != nullptr && (model->type == "pmos" || model->type == "pnp");
    switch (e.kind->letter) {
        case 'm':
            return is_p ? Symbol::pmos : Symbol::nmos;
        case 'q':
            return is_p ? Symbol::pnp : Symbol::npn;
        case 'r':
            return Symbol::resistor;
        case 'c':
            return Symbol::capacitor;
        case 'l':
            return Symbol::inductor;
        case 'd':
            return Symbol::diode;
        case 'v':
            return Symbol::voltage_source;
        case 'i':
            return Symbol::current_source;
        case 'e':
        case 'h':
            return Symbol::controlled_voltage;
        case 'f':
        case 'g':
            return Symbol::controlled_current;
        case 'b':
            return e.expression_is_voltage ? Symbol::controlled_voltage : Symbol::controlled_current;
        case 's':
        case 'w':
            return Symbol::switch_contact;
        default:
            return e.nodes.empty() ? Symbol::note : Symbol::block;
    }
}

/// "5.4 pF" as "5.4p": values are short beside a symbol.
std::string short_quantity(double value) {
    auto text = format_quantity(value, "m");  // any unit
    if (const auto blank = text.find(' '); blank != std::string::npos) {
        text.erase(blank, 1);
        if (!text.empty() && text.back() == 'm') text.pop_back();
        if (!text.empty() && text.back() == 'M') text.back() = 'M';
    }
    return text;
}

void add_transistor_texts(const Element& e, Part& part) {
    const double m = value_or(e.values, "m", 1), stack = value_or(e.values, "stack", 1);
    const auto w = e.values.find("w"), l = e.values.find("l");
    if (e.kind->letter == 'm') part.texts.push_back(fmt::format("{:g} x {:g}", m, stack));
    if (w != e.values.end() && l != e.values.end())
        part.texts.push_back(fmt::format("{}/{}", short_quantity(w->second), short_quantity(l->second)));
}

/// The number of parallel devices and the relative size, where they are not 1.
void add_factor_texts(const Element& e, Part& part) {
    for (const auto* name : {"area", "scale"})
        if (const double factor = value_or(e.values, name, 1); factor != 1) part.texts.push_back(fmt::format("{} {:g}", name, factor));
    if (const double m = value_or(e.values, "m", 1); m != 1 && !is_mos(part.symbol)) part.texts.push_back(fmt::format("m = {:g}", m));
}

std::string shape_text(const Element& e, std::string_view unit) {
    using Shape = Waveform::Shape;
    const auto& waveform = e.waveform;
    switch (waveform.shape) {
        case Shape::force:
            return "force, " + format_quantity(waveform.numbers.empty() ? 1 : waveform.numbers[0], fmt::format("{}/N", unit));
        case Shape::pulse:
            return "pulse";
        case Shape::sine:
            return "sine";
        case Shape::exponential:
            return "exp";
        case Shape::piecewise_linear:
            return "pwl";
        case Shape::noise:
            return "noise";
        default:
            return "modulated";
    }
}

/// The waveform of a source, then its DC value if the line gives it, then its AC stimulus.
std::vector<std::string> source_texts(const Element& e) {
    const auto& waveform = e.waveform;
    const std::string_view unit = e.kind->letter == 'v' ? "V" : "A";
    const auto dc = format_quantity(waveform.dc, unit);
    std::vector<std::string> out;
    if (waveform.shape == Waveform::Shape::none)
        out.push_back(dc);
    else
        out.push_back(shape_text(e, unit));
    if (waveform.shape != Waveform::Shape::none && waveform.has_dc) out.push_back("dc " + dc);
    if (waveform.ac_magnitude != 0) out.push_back("ac " + format_quantity(waveform.ac_magnitude, unit));
    return out;
}

/// The gain of a controlled source, whose unit is that of a conductance or a resistance, or 1.
std::string gain_text(const Element& e) {
    if (e.kind->letter == 'g') return format_quantity(e.value, "S");
    if (e.kind->letter == 'h') return format_quantity(e.value, "ohm");
    return fmt::format("gain {:g}", e.value);
}

std::string value_text(const Element& e) {
    const char letter = e.kind->letter;
    if (e.expression)
        return letter == 'c' ? "q = f(...)" : letter == 'r' ? "r = f(...)" : e.expression_is_voltage ? "v = f(...)" : "i = f(...)";
    if (letter == 'r') return format_quantity(e.value, "ohm");
    if (letter == 'c') return format_quantity(e.value, "F");
    if (letter == 'l') return format_quantity(e.value, "H");
    if (letter == 'e' || letter == 'f' || letter == 'g' || letter == 'h') return gain_text(e);
    if (letter == 'k') return fmt::format("k = {:g}", e.value);
    return "";
}

void add_transistor_pins(const Circuit& circuit, const Element& e, const std::function<int(int)>& net, Part& part) {
    const auto node = [&](std::size_t k) { return net(e.nodes[k]); };
    const bool is_diode = e.nodes[0] == e.nodes[1];
    part.pins = {{node(0), is_diode ? PinRole::input : PinRole::drive}, {node(1), PinRole::sense}, {node(2), PinRole::source}};
    if (e.nodes.size() > 3) part.pins.push_back({node(3), PinRole::bulk});
    const auto* model = circuit.model_of(e);
    if (model == nullptr) return;
    const auto dot = model->name.rfind('.');
    part.type = dot == std::string::npos ? model->name : model->name.substr(dot + 1);
    part.is_high_threshold = part.type.size() > 3 && part.type.substr(part.type.size() - 3) == "_hv";
}

/// The nodes that an expression reads.
std::vector<int> sensed_nodes(const Circuit& circuit, const Element& e) {
    std::vector<int> out;
    if (!e.expression) return out;
    for (const auto& input : e.expression->inputs()) {
        if (input.kind != ExpressionInput::Kind::voltage) continue;
        for (const auto& name : {input.name, input.minus}) {
            const int node = name.empty() ? 0 : circuit.find_node(name);
            if (node > 0 && std::find(out.begin(), out.end(), node) == out.end() && node != e.nodes[0] && node != e.nodes[1])
                out.push_back(node);
        }
    }
    return out;
}

void add_two_ends(const Circuit& circuit, const Element& e, const std::function<int(int)>& net, Part& part) {
    const bool drives = part.symbol == Symbol::current_source || part.symbol == Symbol::controlled_current ||
                        part.symbol == Symbol::controlled_voltage || (part.symbol == Symbol::voltage_source && !part.is_ammeter);
    for (std::size_t k = 0; k < std::min<std::size_t>(e.nodes.size(), 2); ++k)
        part.pins.push_back({net(e.nodes[k]), drives ? PinRole::drive : PinRole::passive});
    for (std::size_t k = 2; k < e.nodes.size(); ++k) part.pins.push_back({net(e.nodes[k]), PinRole::sense});
    const auto sensed = sensed_nodes(circuit, e);
    if (sensed.size() <= max_sense_pins)
        for (const int node : sensed) part.pins.push_back({net(node), PinRole::sense});
}

/// A device that has no symbol: a box with numbered pins.
Part boxed(const Element& e, const std::function<int(int)>& net, Part part) {
    part.is_device_box = true, part.type = std::string(e.kind->description.substr(0, 20));
    for (std::size_t k = 0; k < e.nodes.size(); ++k)
        part.pins.push_back({net(e.nodes[k]), PinRole::passive, fmt::format("{}", k + 1), k % 2 == 0 ? Direction::left : Direction::right});
    return part;
}

}  // namespace

Part part_of_element(const Circuit& circuit, const Element& e, std::string name, const std::function<int(int)>& net) {
    Part part;
    part.symbol = symbol_of(circuit, e), part.name = std::move(name), part.path = e.name;
    const auto& waveform = e.waveform;
    part.is_signal_source = waveform.shape != Waveform::Shape::none || waveform.ac_magnitude != 0;
    part.is_ammeter = part.symbol == Symbol::voltage_source && !part.is_signal_source && waveform.dc == 0;
    if (is_transistor(part.symbol)) {
        add_transistor_pins(circuit, e, net, part);
        add_transistor_texts(e, part);
        add_factor_texts(e, part);
        return part;
    }
    if (part.symbol == Symbol::block) return boxed(e, net, std::move(part));
    add_two_ends(circuit, e, net, part);
    part.has_controlling_pair = !e.expression && e.nodes.size() == 4;
    if (e.kind->letter == 'v' || e.kind->letter == 'i') part.texts = source_texts(e);
    if (const auto text = value_text(e); !text.empty()) part.texts.push_back(text);
    add_factor_texts(e, part);
    if (!e.control_source.empty()) part.texts.push_back("i(" + e.control_source.substr(e.control_source.rfind('.') + 1) + ")");
    if (const auto* model = circuit.model_of(e); model != nullptr) part.type = model->name.substr(model->name.rfind('.') + 1);
    if (part.symbol == Symbol::note)
        for (const auto& inductor : e.inductors) part.texts.push_back(inductor.substr(inductor.rfind('.') + 1));
    return part;
}

}  // namespace corpuscle::circuit::schematic
