#include "circuit/measure/missing_curve.hpp"

#include <algorithm>

#include "circuit/expression/expression_operations.hpp"
#include "circuit/output/curve_view.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

constexpr std::string_view noise_quantities[] = {"onoise", "inoise", "inoise_total", "onoise_total"};

std::string with_dots(std::string_view name) {
    std::string out(trimmed(name));
    std::ranges::replace(out, ':', '.');
    return out;
}

bool is_node(const Circuit& c, std::string_view name) {
    const auto node = with_dots(name);
    return is_ground(node) || c.find_node(node) >= 0;
}

/// True for an element, and for a subcircuit or a node of one: m1, x1, x1.a.
bool is_device(const Circuit& c, std::string_view name) {
    const auto device = with_dots(name);
    if (c.find_element(device) >= 0) return true;
    const auto instance = device.substr(0, device.find('.')) + ".";
    return device.starts_with('x') && std::ranges::any_of(c.elements, [&](const Element& e) { return e.name.starts_with(instance); });
}

/// True for v(a), vi(a,b), id(m1), p(r1), @m1[gm] and m1:power of nodes and elements that the circuit has.
bool is_quantity(const Circuit& c, std::string_view name) {
    if (std::ranges::find(noise_quantities, name) != std::end(noise_quantities)) return true;
    if (name.starts_with('@')) return is_device(c, name.substr(1, name.find('[') - 1));
    const auto open = name.find('(');
    if (open == std::string_view::npos) {
        const auto colon = name.rfind(':');
        return colon != std::string_view::npos && is_device(c, name.substr(0, colon));
    }
    if (open == 0 || !name.ends_with(')')) return false;
    const auto inside = name.substr(open + 1, name.size() - open - 2);
    const auto comma = inside.find(',');
    const auto first = inside.substr(0, comma);
    if (name[0] == 'v' && is_node(c, first) && (comma == inside.npos || is_node(c, inside.substr(comma + 1)))) return true;
    return is_device(c, first);
}

/// The calls in an expression that are not functions: "v(a,b)", "id(m1)".
std::vector<std::string_view> quantities_in(std::string_view text) {
    const auto is_in_name = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
    std::vector<std::string_view> out;
    for (std::size_t open = text.find('('); open != std::string_view::npos; open = text.find('(', open + 1)) {
        auto from = open;
        while (from > 0 && is_in_name(text[from - 1])) --from;
        const auto name = text.substr(from, open - from);
        const auto close = text.find(')', open);
        if (name.empty() || close == std::string_view::npos || find_function(name, true) || find_part_function(name)) continue;
        out.push_back(text.substr(from, close + 1 - from));
    }
    return out;
}

}  // namespace

std::optional<std::string> unavailable_quantity(const Circuit& circuit, const Plot& plot, std::string_view name) {
    const auto text = curve_expression_text(name);
    const auto names = text ? quantities_in(*text) : std::vector{name};
    std::optional<std::string> out;
    for (const auto quantity : names) {
        const bool is_available = CurveView::find(plot, quantity) && !(text && plot.is_complex && quantity[1] == '(');
        if (is_available) continue;
        if (!is_quantity(circuit, quantity)) return {};
        if (!out) out = quantity;
    }
    return out;
}

}  // namespace corpuscle::circuit
