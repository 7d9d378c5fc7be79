#include "circuit/export/export_names.hpp"

#include <algorithm>

#include "circuit/devices.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

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
    return e.name.find('.') != std::string::npos ? fmt::format("{}{}_{}", prefix, e.letter, e.name) : fmt::format("{}{}", prefix, e.name);
}

bool is_in_name(char c) { return is_letter_or_digit(c) || c == '_' || c == '.' || c == '#' || c == '@'; }

}  // namespace

ExportNames::ExportNames(const Circuit& circuit) : circuit_(circuit) {
    nodes_ = unique_names(circuit.nodes, "_.#");
    std::vector<std::string> elements, models;
    for (const auto& e : circuit.elements) elements.push_back(legal(exported_name(e), "_"));
    for (const auto& m : circuit.models) models.push_back(legal(m.name, "_"));
    elements_ = unique_names(elements, "_"), models_ = unique_names(models, "_");
}

std::string ExportNames::node(std::string_view name) const {
    const int number = name == "gnd" ? 0 : circuit_.find_node(name);
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
