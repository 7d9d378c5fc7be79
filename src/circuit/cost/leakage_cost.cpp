#include "circuit/cost/leakage_cost.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "circuit/device/named_values.hpp"
#include "circuit/device/physical_constants.hpp"

namespace corpuscle::circuit {
namespace {

enum Terminal { D, G, S, B };

/// Merges nodes that are connected by 0 V sources, which only measure a current.
class MergedNodes {
    std::vector<int> representative_;  // by node: the lowest number of the nodes merged with it

public:
    explicit MergedNodes(const Circuit& circuit) : representative_(circuit.nodes.size()) {
        std::iota(representative_.begin(), representative_.end(), 0);
        for (const auto& e : circuit.elements) {
            if (!is_wire(e)) continue;
            const int first = representative(e.nodes[0]), second = representative(e.nodes[1]);
            std::replace(representative_.begin(), representative_.end(), std::max(first, second), std::min(first, second));
        }
    }
    static bool is_wire(const Element& e) {
        return e.letter == 'v' && e.waveform.dc == 0 && e.waveform.shape == Waveform::Shape::none && e.waveform.ac_magnitude == 0;
    }
    int representative(int node) const { return representative_[static_cast<std::size_t>(node)]; }
};

/// Nodes whose voltage is held by a capacitor and not by a voltage source. Maps the representative of the merged nodes to the node of the
/// capacitor.
std::map<int, int> capacitor_nodes(const Circuit& circuit, const MergedNodes& merged) {
    std::map<int, int> out;
    for (const auto& e : circuit.elements)
        if (e.letter == 'c')
            for (int k = 0; k < 2; ++k)
                out.emplace(merged.representative(e.nodes[static_cast<std::size_t>(k)]), e.nodes[static_cast<std::size_t>(k)]);
    out.erase(0);  // ground
    for (const auto& e : circuit.elements)
        if (e.letter == 'v' && !MergedNodes::is_wire(e))
            for (const int node : e.nodes) out.erase(merged.representative(node));
    return out;
}

/// The magnitude of the drain current, A, with the gate at the source voltage and `supply` (V) between drain and source. `forward` (V) is
/// the voltage of the bulk above the source, with the signs of an NMOS. `polarity`: 1 for NMOS, -1 for PMOS.
double drain_current(const Device& d, double polarity, double supply, double forward) {
    const double v[4] = {polarity * supply, 0, 0, polarity * forward};
    double f[4] = {}, q[4] = {}, df[16] = {}, dq[16] = {};
    EvalContext context;
    context.with_charges = false;
    d.eval(v, context, {f, q, df, dq});
    return std::abs(f[D]);
}

}  // namespace

std::vector<Leakage> leakage_of(const System& system, std::span<const double> x, double supply) {
    std::vector<Leakage> out;
    const auto& circuit = system.circuit();
    const MergedNodes merged(circuit);
    const auto capacitor_node_of = capacitor_nodes(circuit, merged);
    for (std::size_t k = 0; k < circuit.elements.size(); ++k) {
        const auto& e = circuit.elements[k];
        if (e.letter != 'm') continue;
        const auto& d = *system.devices()[k];
        const double polarity = circuit.models[static_cast<std::size_t>(e.model)].type == "pmos" ? -1 : 1;
        const auto v = system.terminal_values(d, x);
        const double source = std::min(polarity * v[D], polarity * v[S]);
        Leakage leak{k, drain_current(d, polarity, supply, std::max(polarity * v[B] - source, 0.0)), polarity * v[G] - source, false, ""};
        leak.is_off = leak.V_GS < thermal_voltage(circuit.temperature + zero_celsius);
        for (const auto end : {D, S})
            if (const auto node = capacitor_node_of.find(merged.representative(e.nodes[end]));
                leak.capacitor_node.empty() && node != capacitor_node_of.end())
                leak.capacitor_node = circuit.nodes[static_cast<std::size_t>(node->second)];
        out.push_back(std::move(leak));
    }
    return out;
}

double smallest_bias(const Circuit& circuit) {
    double smallest = 0;
    for (const auto& e : circuit.elements) {
        if (e.letter != 'i' || e.waveform.shape == Waveform::Shape::force) continue;
        const double i = std::abs(e.waveform.dc * value_or(e.values, "m", 1));
        if (i > 0 && (smallest == 0 || i < smallest)) smallest = i;
    }
    return smallest;
}

}  // namespace corpuscle::circuit
