#include "circuit/netlist/settings/node_voltages.hpp"

#include <algorithm>
#include <ranges>

#include "circuit/netlist/settings/directive_words.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

/// The name in the circuit of a node that Xyce calls x1:a.
std::string with_dots(std::string name) {
    std::ranges::replace(name, ':', '.');
    return name;
}

}  // namespace

void NodeVoltages::find_paths(std::span<const Statement* const> lines) {
    for (const auto* s : lines)
        for (std::size_t k = 1; k < s->words.size(); ++k) {
            const auto text = s->text(k);
            const auto close = text.find(')');
            if (!text.starts_with("v(") || close == std::string_view::npos) continue;
            const auto name = with_dots(std::string(trimmed(text.substr(2, close - 2))));
            if (name.find('.') != std::string::npos) paths_.emplace(name, -1);
        }
}

void NodeVoltages::connect_port(const std::string& path, const std::string& port, int node) {
    if (paths_.empty()) return;
    if (const auto named = paths_.find(path + port); named != paths_.end()) named->second = node;
}

Result<void> NodeVoltages::read(const CircuitBuilder& builder, const Scope& scope, const Statement& s) {
    for (std::size_t k = 1; k < s.words.size(); ++k) {
        const auto text = s.text(k);
        const auto close = text.find(')'), equals = text.find_first_not_of(" \t", std::min(close, text.size() - 1) + 1);
        if (!text.starts_with("v(") || close == std::string_view::npos || equals == std::string_view::npos || text[equals] != '=')
            return error_at(s.location(k), "expected v(node)=value, not '{}'", text);
        auto from = text.find_first_not_of(" \t", equals + 1);
        const auto value = TRY(scope.evaluate(without_braces(s, s.words[k], static_cast<std::uint32_t>(std::min(from, text.size())))));
        const auto node = trimmed(text.substr(2, close - 2));
        if (is_ground(node)) return error_at(s.location(k), "ground is always at 0 V");
        voltages_.push_back({builder.node_name(scope, node), value, s.location(k), s.text(0) == ".ic"});
    }
    return {};
}

Result<void> NodeVoltages::resolve(Circuit& c) const {
    for (const auto& voltage : voltages_) {
        int k = c.find_node(voltage.node);
        if (k < 0) {
            const auto name = with_dots(voltage.node);
            const auto port = paths_.find(name);
            k = port != paths_.end() && port->second >= 0 ? port->second : c.find_node(name);
        }
        if (k < 0) {
            const auto suggestion = did_you_mean(voltage.node, c.nodes | std::views::drop(1));
            if (!suggestion.empty()) return error_at(voltage.location, "unknown node '{}'{}", voltage.node, suggestion);
            c.warnings.push_back(error_at(voltage.location, "there is no node '{}', so its voltage has no effect", voltage.node));
            continue;
        }
        (voltage.is_ic ? c.ic : c.nodesets).emplace_back(k, voltage.value);
    }
    return {};
}

}  // namespace corpuscle::circuit
