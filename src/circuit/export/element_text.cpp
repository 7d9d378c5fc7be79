#include "circuit/export/element_text.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "circuit/device/named_values.hpp"
#include "circuit/export/pwl_force.hpp"
#include "circuit/export/transistor_text.hpp"

namespace corpuscle::circuit {
namespace {

/// Writes one element.
class ElementText {
    const Circuit& circuit_;
    const Element& e_;
    const ExportNames& names_;
    std::string head_;  // name and nodes

public:
    ElementText(const Circuit& circuit, std::size_t k, const ExportNames& names)
        : circuit_(circuit), e_(circuit.elements[k]), names_(names), head_(names.element(k)) {
        for (const int node : e_.nodes) head_ += ' ' + names.node(node);
    }

    Result<std::string> text() const {
        if (e_.expression) return with_expression();
        switch (e_.letter) {
            case 'r':
            case 'c':
            case 'l':
                return passive();
            case 'v':
            case 'i':
                return source();
            case 'e':
            case 'g':
                return fmt::format("{} {}\n", head_, e_.value * (e_.letter == 'g' ? value("m", 1) : 1));
            case 'f':
            case 'h':
                return fmt::format("{} {} {}\n", head_, names_.element(e_.control_source),
                                   e_.value * (e_.letter == 'f' ? value("m", 1) : 1));
            case 'd':
                return fmt::format("{} {} area={}{}\n", head_, names_.model(e_.model), value("area", 1) * value("m", 1), temperature());
            case 'm':
                return transistor();
            default:
                return bad_input(fmt::format("{}: elements with the letter '{}' cannot be exported", e_.name, e_.letter), e_.location);
        }
    }

private:
    double value(std::string_view name, double default_value) const { return value_or(e_.values, name, default_value); }
    const Model* model() const { return e_.model < 0 ? nullptr : &circuit_.models[static_cast<std::size_t>(e_.model)]; }
    /// The value with this name of the element, else of its model, else the default.
    double value_or_of_model(std::string_view name, double default_value) const {
        return value(name, model() ? value_or(model()->values, name, default_value) : default_value);
    }
    /// The temperature of the element, C.
    double celsius() const { return value("temp", circuit_.temperature + value("dtemp", 0)); }
    /// " temp=..." or " dtemp=..." if the element has it.
    std::string temperature() const {
        if (e_.values.contains("temp")) return fmt::format(" temp={}", value("temp", 0));
        return e_.values.contains("dtemp") ? fmt::format(" dtemp={}", value("dtemp", 0)) : "";
    }

    /// An R, C or L; m parallel ones are merged into one. An element that .dc sweeps is written with its value at its temperature and
    /// without temperature coefficients, because ngspice would apply these to each value of the sweep.
    std::string passive() const {
        const double m = value("m", 1), scaled = e_.value * value("scale", 1), total = e_.letter == 'c' ? scaled * m : scaled / m;
        const double tc1 = value_or_of_model("tc1", 0), tc2 = value_or_of_model("tc2", 0),
                     dT = celsius() - value_or_of_model("tnom", value_or(circuit_.options, "tnom", 27));
        if (is_swept()) return fmt::format("{} {}{}\n", head_, total * (1 + tc1 * dT + tc2 * dT * dT), temperature());
        std::string out = fmt::format("{} {}", head_, total);
        if (model() && model()->values.contains("tnom")) out += ' ' + names_.model(e_.model);
        if (tc1 != 0 || tc2 != 0) out += fmt::format(" tc1={} tc2={}", tc1, tc2);
        if (e_.values.contains("ic")) out += fmt::format(" ic={}", value("ic", 0));
        return out + temperature() + '\n';
    }
    /// True if .dc sweeps the element.
    bool is_swept() const {
        return std::any_of(circuit_.directives.begin(), circuit_.directives.end(), [this](const Directive& c) {
            return c.name == "dc" && std::find(c.words.begin(), c.words.end(), e_.name) != c.words.end();
        });
    }

    Result<std::string> source() const {
        const Waveform& w = e_.waveform;
        const bool force = w.shape == Waveform::Shape::force, has_shape = w.shape != Waveform::Shape::none && !force;
        // In ngspice the DC value of a sine with a phase depends on the phase. In Corpuscle it is the offset, so the offset is written as
        // dc.
        const bool has_phase = w.shape == Waveform::Shape::sine && w.numbers.size() > 5;
        std::string out = head_;
        if (w.has_dc || !has_shape || has_phase) out += fmt::format(" dc {}", w.has_dc || !has_phase ? w.dc : w.numbers[0]);
        if (w.ac_magnitude != 0 || w.ac_phase != 0) out += fmt::format(" ac {} {}", w.ac_magnitude, w.ac_phase);
        if (has_shape) out += fmt::format(" {}({:})", shape_name(w.shape), fmt::join(w.numbers, " "));
        if (e_.letter == 'i' && value("m", 1) != 1) out += fmt::format(" m={}", value("m", 1));
        if (!force) return out + '\n';
        const auto points = TRY(pwl_force(circuit_, w.numbers.empty() ? 1 : w.numbers[0]));
        if (points.empty()) return fmt::format("* {} is a FORCE source in Corpuscle; here it is constant\n{}\n", e_.name, out);
        return fmt::format("* {}: the force of .force, piecewise linear\n{} {}\n", e_.name, out, points);
    }
    static std::string_view shape_name(Waveform::Shape shape) {
        switch (shape) {
            case Waveform::Shape::pulse:
                return "pulse";
            case Waveform::Shape::sine:
                return "sin";
            case Waveform::Shape::exponential:
                return "exp";
            default:
                return "pwl";
        }
    }

    Result<std::string> with_expression() const {
        auto text = e_.expression->text([this](const ExpressionInput& in) { return input(in); });
        if (!text) return bad_input(fmt::format("{}: {}", e_.name, text.error().message), e_.location);
        const bool is_voltage = e_.expression_is_voltage;
        if (const double m = value("m", 1); m != 1 && !is_voltage) *text = fmt::format("{}*({})", m, *text);
        switch (e_.letter) {
            case 'c':
                return fmt::format("{} q='{}'\n", head_, *text);
            case 'e':
                return fmt::format("{} vol='{}'\n", head_, *text);
            case 'g':
                return fmt::format("{} cur='{}'\n", head_, *text);
            default:
                return fmt::format("{} {}={}\n", head_, is_voltage ? 'v' : 'i', *text);
        }
    }

    /// A voltage, current, time or temperature in an expression.
    std::string input(const ExpressionInput& in) const {
        switch (in.kind) {
            case ExpressionInput::Kind::voltage:
                return in.minus.empty() ? fmt::format("v({})", names_.node(in.name))
                                        : fmt::format("v({},{})", names_.node(in.name), names_.node(in.minus));
            case ExpressionInput::Kind::current:
                return fmt::format("i({})", names_.element(in.name));
            case ExpressionInput::Kind::time:
                return "time";
            case ExpressionInput::Kind::temperature:
                if (e_.values.contains("temp")) return fmt::format("{}", celsius());
                return e_.values.contains("dtemp") ? fmt::format("(temper+{})", value("dtemp", 0)) : "temper";
        }
        return "0";
    }

    Result<std::string> transistor() const {
        const auto card = TRY(read_model_card<UicmCard>(UicmCard::fields, *model(), {"level"}));
        UicmInstance size;
        for (const auto& f : UicmInstance::fields) size.*f.member = value(f.name, size.*f.member);
        const bool pmos = model()->type == "pmos";
        return fmt::format("{} {} {}", head_, pmos ? "uicm_p" : "uicm_n", uicm_parameters(card, size, celsius(), pmos));
    }
};

}  // namespace

Result<std::string> element_text(const Circuit& circuit, std::size_t element, const ExportNames& names) {
    return ElementText(circuit, element, names).text();
}

std::string model_text(const Circuit& circuit, std::size_t k, const ExportNames& names) {
    const Model& m = circuit.models[k];
    if (m.type == "r" || m.type == "c" || m.type == "l") {
        const double tnom = value_or(m.values, "tnom", 27);
        return m.values.contains("tnom") ? fmt::format(".model {} {}(tnom={})\n", names.model(static_cast<int>(k)), m.type, tnom) : "";
    }
    if (m.type != "d") return "";
    std::string out = fmt::format(".model {} d(", names.model(static_cast<int>(k)));
    for (const auto& [name, value] : m.values) {
        const bool is_left_out = name == "level" || name == "jsw" || name == "ikf" || name == "trs" || name == "rsw" ||
                                 (name == "bv" && value == 0) || (name == "cjo" && m.values.contains("cj0"));
        if (!is_left_out) out += fmt::format("{}{}={}", out.back() == '(' ? "" : " ", name == "cj0" ? "cjo" : name, value);
    }
    return out + ")\n";
}

}  // namespace corpuscle::circuit
