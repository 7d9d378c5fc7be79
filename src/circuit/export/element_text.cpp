#include "circuit/export/element_text.hpp"

#include "circuit/device/mos/mos1_card.hpp"
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
        case ExpressionInput::Kind::frequency:
            return "hertz";
        case ExpressionInput::Kind::part:  // only in expressions of curves
            return "0";
        case ExpressionInput::Kind::temperature:
            if (e.element.values.contains("temp")) return fmt::format("{}", celsius_of(e.circuit, e.element));
            return e.element.values.contains("dtemp") ? fmt::format("(temper+{})", e.value("dtemp", 0)) : "temper";
    }
    return "0";
}

bool is_letter_or_digit(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); }

/// The name in small letters, with all characters but letters, digits and those of `allowed` replaced by _.
std::string legal(std::string_view name, std::string_view allowed) {
    std::string out;
    for (const char c : name) out += is_letter_or_digit(lower(c)) || allowed.find(c) != std::string_view::npos ? lower(c) : '_';
    return out;
}

/// Makes the names legal and unique. Names that are legal already keep their text; of equal ones, the first does.
std::vector<std::string> unique_names(const std::vector<std::string>& wanted, std::string_view allowed) {
    std::set<std::string, std::less<>> taken;
    std::vector<std::string> out(wanted.size());
    for (std::size_t k = 0; k < wanted.size(); ++k)
        if (legal(wanted[k], allowed) == wanted[k] && taken.insert(wanted[k]).second) out[k] = wanted[k];
    for (std::size_t k = 0; k < wanted.size(); ++k) {
        const auto legal_name = legal(wanted[k], allowed);
        for (int n = 1; out[k].empty(); ++n)
            if (auto name = n == 1 ? legal_name : fmt::format("{}_{}", legal_name, n); taken.insert(name).second) out[k] = std::move(name);
    }
    return out;
}

/// The name that an element has in the export, before illegal characters are replaced.
std::string exported_name(const Element& e) {
    const auto prefix = kind_of(e).export_prefix;
    const bool has_letter = e.name.find('.') == std::string::npos && e.name[0] == e.letter;  // not x1.r1, nor the resistance c1#rser
    return has_letter ? fmt::format("{}{}", prefix, e.name) : fmt::format("{}{}_{}", prefix, e.letter, e.name);
}

bool is_in_name(char c) { return is_letter_or_digit(c) || c == '_' || c == '.' || c == '#' || c == '@'; }

}  // namespace

double ElementExport::value(std::string_view name, double default_value) const { return value_or(element.values, name, default_value); }

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

std::string element_head(const Circuit& circuit, std::size_t k, const ExportNames& names) {
    std::string head = names.element(k);
    for (const int node : circuit.elements[k].nodes) head += ' ' + names.node(node);
    return head;
}

Result<std::string> element_text(const Circuit& circuit, std::size_t k, const ExportNames& names) {
    const Element& e = circuit.elements[k];
    const auto& kind = kind_of(e);
    if (kind.write_spice == nullptr) return error_at(e.location, "{}: elements with the letter '{}' cannot be exported", e.name, e.letter);
    return kind.write_spice({circuit, e, names, element_head(circuit, k, names)});
}

std::string model_text(const Circuit& circuit, std::size_t k, const ExportNames& names) {
    const Model& m = circuit.models[k];
    if (m.type == "r" || m.type == "c" || m.type == "l") {
        const double tnom = value_or(m.values, "tnom", 27);
        return m.values.contains("tnom") ? fmt::format(".model {} {}(tnom={})\n", names.model(static_cast<int>(k)), m.type, tnom) : "";
    }
    if ((m.type == "nmos" || m.type == "pmos") && value_or(m.values, "level", 1) == 1)
        return mos1_model_line(m, names.model(static_cast<int>(k)));
    if (m.type != "d" && m.type != "npn" && m.type != "pnp") return "";
    std::string out = fmt::format(".model {} {}(", names.model(static_cast<int>(k)), m.type);
    for (const auto& [name, value] : m.values) {
        const bool is_left_out =
            name == "level" ||
            (m.type == "d" && (name == "jsw" || name == "rsw" || name == "tbv2" || name == "tikf" || (name == "bv" && value == 0))) ||
            (name == "cjo" && m.values.contains("cj0"));
        if (m.type == "d" && (name == "tbv1" || name == "tcv")) {  // ngspice has the decrease of bv in volts
            if (name == "tcv" && m.values.contains("tbv1")) continue;
            const double decrease = value_or(m.values, "tcv", 0) - value_or(m.values, "tbv1", 0) * value_or(m.values, "bv", 0);
            out += fmt::format("{}tcv={}", out.back() == '(' ? "" : " ", decrease);
            continue;
        }
        if (!is_left_out) out += fmt::format("{}{}={}", out.back() == '(' ? "" : " ", name == "cj0" ? "cjo" : name, value);
    }
    return out + ")\n";
}

ExportNames::ExportNames(const Circuit& circuit) : circuit_(circuit) {
    nodes_ = unique_names(circuit.nodes, "_.#");
    std::vector<std::string> elements, models;
    for (const auto& e : circuit.elements) elements.push_back(legal(exported_name(e), "_"));
    for (const auto& m : circuit.models) models.push_back(legal(m.name, "_"));
    elements_ = unique_names(elements, "_"), models_ = unique_names(models, "_");
}

std::string ExportNames::node(std::string_view name) const {
    const int number = is_ground(name) ? 0 : circuit_.find_node(name);
    return number < 0 ? "" : nodes_[static_cast<std::size_t>(number)];
}

std::string ExportNames::element(std::string_view name) const {
    const int number = circuit_.find_element(name);
    return number < 0 ? "" : elements_[static_cast<std::size_t>(number)];
}

std::string ExportNames::word(std::string_view text) const {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        const auto open = text.find('(', at), close = text.find(')', std::min(open, text.size()));
        if (close == std::string_view::npos) return out + std::string(text.substr(at));
        std::size_t name = open;  // start of the function's name
        while (name > at && is_in_name(text[name - 1])) --name;
        out += text.substr(at, open + 1 - at);
        at = open + 1;
        const char kind = name < open ? text[name] : ' ';               // first letter of the function's name
        if (open - name > 3 || (kind != 'v' && kind != 'i')) continue;  // a view such as v vm vdb, but not max(
        auto inside = text.substr(at, close - at);
        for (bool first = true; first || !inside.empty(); first = false) {
            const auto comma = std::min(inside.find(','), inside.size());
            const auto name_here = inside.substr(0, comma);
            const auto known = kind == 'v' ? node(name_here) : element(name_here);
            out += fmt::format("{}{}", first ? "" : ",", known.empty() ? std::string(name_here) : known);
            inside.remove_prefix(std::min(comma + 1, inside.size()));
        }
        at = close;
    }
    return out;
}

}  // namespace corpuscle::circuit
