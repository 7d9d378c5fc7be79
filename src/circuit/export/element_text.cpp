#include "circuit/export/element_text.hpp"

#include <fmt/format.h>

#include "circuit/device/named_values.hpp"
#include "circuit/devices.hpp"

namespace corpuscle::circuit {
namespace {

/// A voltage, current, time or temperature in an expression.
std::string input_text(const ElementExport& e, const ExpressionInput& in) {
    switch (in.kind) {
        case ExpressionInput::Kind::voltage:
            return in.minus.empty() ? fmt::format("v({})", e.names.node(in.name))
                                    : fmt::format("v({},{})", e.names.node(in.name), e.names.node(in.minus));
        case ExpressionInput::Kind::current:
            return fmt::format("i({})", e.names.element(in.name));
        case ExpressionInput::Kind::time:
            return "time";
        case ExpressionInput::Kind::temperature:
            if (e.element.values.contains("temp")) return fmt::format("{}", e.celsius());
            return e.element.values.contains("dtemp") ? fmt::format("(temper+{})", e.value("dtemp", 0)) : "temper";
    }
    return "0";
}

}  // namespace

double ElementExport::value(std::string_view name, double default_value) const { return value_or(element.values, name, default_value); }

double ElementExport::value_or_of_model(std::string_view name, double default_value) const {
    return value(name, model() ? value_or(model()->values, name, default_value) : default_value);
}

double ElementExport::celsius() const { return value("temp", circuit.temperature + value("dtemp", 0)); }

std::string ElementExport::temperature() const {
    if (element.values.contains("temp")) return fmt::format(" temp={}", value("temp", 0));
    return element.values.contains("dtemp") ? fmt::format(" dtemp={}", value("dtemp", 0)) : "";
}

Result<std::string> ElementExport::expression() const {
    const auto text = element.expression->text([this](const ExpressionInput& in) { return input_text(*this, in); });
    if (!text) return error_at(element.location, "{}: {}", element.name, text.error().message);
    const double m = value("m", 1);
    return m != 1 && !element.expression_is_voltage ? fmt::format("{}*({})", m, *text) : *text;
}

Result<std::string> element_text(const Circuit& circuit, std::size_t k, const ExportNames& names) {
    const Element& e = circuit.elements[k];
    const auto& kind = kind_of(e);
    if (kind.write_spice == nullptr) return error_at(e.location, "{}: elements with the letter '{}' cannot be exported", e.name, e.letter);
    std::string head = names.element(k);
    for (const int node : e.nodes) head += ' ' + names.node(node);
    return kind.write_spice({circuit, e, names, std::move(head)});
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
