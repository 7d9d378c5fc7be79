#include "circuit/export/elements.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "circuit/device/values.hpp"
#include "circuit/export/force.hpp"
#include "circuit/export/transistor_text.hpp"

namespace corpuscle::circuit {
namespace {

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
        if (e_.formula) return by_formula();
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
                return fmt::format("{} {}\n", head_, e_.value * (e_.letter == 'g' ? said("m", 1) : 1));
            case 'f':
            case 'h':
                return fmt::format("{} {} {}\n", head_, names_.element(e_.control), e_.value * (e_.letter == 'f' ? said("m", 1) : 1));
            case 'd':
                return fmt::format("{} {} area={}{}\n", head_, names_.model(e_.model), said("area", 1) * said("m", 1), temperature());
            case 'm':
                return transistor();
            default:
                return bad_input(fmt::format("{}: an element of letter '{}' cannot be exported", e_.name, e_.letter), e_.place);
        }
    }

private:
    double said(std::string_view name, double otherwise) const { return value_or(e_.values, name, otherwise); }
    const Model* model() const { return e_.model < 0 ? nullptr : &circuit_.models[static_cast<std::size_t>(e_.model)]; }
    /// By the element, or else by its model.
    double said_or_of_model(std::string_view name, double otherwise) const {
        return said(name, model() ? value_or(model()->values, name, otherwise) : otherwise);
    }
    double celsius() const { return said("temp", circuit_.temperature + said("dtemp", 0)); }
    std::string temperature() const {
        if (e_.values.contains("temp")) return fmt::format(" temp={}", said("temp", 0));
        return e_.values.contains("dtemp") ? fmt::format(" dtemp={}", said("dtemp", 0)) : "";
    }

    /// Several in parallel as one. What a .dc sweeps stands as worked out: ngspice would apply the temperature to each value of the sweep.
    std::string passive() const {
        const double m = said("m", 1), scaled = e_.value * said("scale", 1), value = e_.letter == 'c' ? scaled * m : scaled / m;
        const double tc1 = said_or_of_model("tc1", 0), tc2 = said_or_of_model("tc2", 0),
                     dT = celsius() - said_or_of_model("tnom", value_or(circuit_.options, "tnom", 27));
        if (swept()) return fmt::format("{} {}{}\n", head_, value * (1 + tc1 * dT + tc2 * dT * dT), temperature());
        std::string out = fmt::format("{} {}", head_, value);
        if (model() && model()->values.contains("tnom")) out += ' ' + names_.model(e_.model);
        if (tc1 != 0 || tc2 != 0) out += fmt::format(" tc1={} tc2={}", tc1, tc2);
        if (e_.values.contains("ic")) out += fmt::format(" ic={}", said("ic", 0));
        return out + temperature() + '\n';
    }
    bool swept() const {
        return std::any_of(circuit_.commands.begin(), circuit_.commands.end(), [this](const Command& c) {
            return c.name == "dc" && std::find(c.words.begin(), c.words.end(), e_.name) != c.words.end();
        });
    }

    Result<std::string> source() const {
        const Waveform& w = e_.waveform;
        const bool force = w.shape == Waveform::Shape::force, shaped = w.shape != Waveform::Shape::none && !force;
        // A sine begins with its phase there, here with its offset.
        const bool phase = w.shape == Waveform::Shape::sine && w.numbers.size() > 5;
        std::string out = head_;
        if (w.has_dc || !shaped || phase) out += fmt::format(" dc {}", w.has_dc || !phase ? w.dc : w.numbers[0]);
        if (w.ac_magnitude != 0 || w.ac_phase != 0) out += fmt::format(" ac {} {}", w.ac_magnitude, w.ac_phase);
        if (shaped) out += fmt::format(" {}({:})", shape_name(w.shape), fmt::join(w.numbers, " "));
        if (e_.letter == 'i' && said("m", 1) != 1) out += fmt::format(" m={}", said("m", 1));
        if (!force) return out + '\n';
        const auto points = force_points(circuit_, w.numbers.empty() ? 1 : w.numbers[0]);
        if (!points) return points.error();
        if (points->empty()) return fmt::format("* {} hands in a force in Corpuscle; here it rests\n{}\n", e_.name, out);
        return fmt::format("* {}: the force of .force, in straight lines\n{} {}\n", e_.name, out, *points);
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

    Result<std::string> by_formula() const {
        auto text = e_.formula->text([this](const FormulaInput& in) { return input(in); });
        if (!text) return bad_input(fmt::format("{}: {}", e_.name, text.error().sentence), e_.place);
        const bool voltage = e_.formula_is_voltage;
        if (const double m = said("m", 1); m != 1 && !voltage) *text = fmt::format("{}*({})", m, *text);
        switch (e_.letter) {
            case 'c':
                return fmt::format("{} q='{}'\n", head_, *text);
            case 'e':
                return fmt::format("{} vol='{}'\n", head_, *text);
            case 'g':
                return fmt::format("{} cur='{}'\n", head_, *text);
            default:
                return fmt::format("{} {}={}\n", head_, voltage ? 'v' : 'i', *text);
        }
    }

    std::string input(const FormulaInput& in) const {
        switch (in.kind) {
            case FormulaInput::Kind::voltage:
                return in.minus.empty() ? fmt::format("v({})", names_.node(in.name))
                                        : fmt::format("v({},{})", names_.node(in.name), names_.node(in.minus));
            case FormulaInput::Kind::current:
                return fmt::format("i({})", names_.element(in.name));
            case FormulaInput::Kind::time:
                return "time";
            case FormulaInput::Kind::temperature:
                if (e_.values.contains("temp")) return fmt::format("{}", celsius());
                return e_.values.contains("dtemp") ? fmt::format("(temper+{})", said("dtemp", 0)) : "temper";
        }
        return "0";
    }

    Result<std::string> transistor() const {
        const auto card = card_from<UicmCard>(UicmCard::fields, *model(), {"level"});
        if (!card) return card.error();
        UicmInstance size;
        for (const auto& f : UicmInstance::fields) size.*f.at = said(f.name, size.*f.at);
        const bool pmos = model()->type == "pmos";
        return fmt::format("{} {} {}", head_, pmos ? "uicm_p" : "uicm_n", uicm_parameters(*card, size, celsius(), pmos));
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
        const bool absent = name == "level" || name == "jsw" || name == "ikf" || name == "trs" || name == "rsw" ||
                            (name == "bv" && value == 0) || (name == "cjo" && m.values.contains("cj0"));
        if (!absent) out += fmt::format("{}{}={}", out.back() == '(' ? "" : " ", name == "cj0" ? "cjo" : name, value);
    }
    return out + ")\n";
}

}  // namespace corpuscle::circuit
