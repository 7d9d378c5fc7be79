#include "circuit/cost/leakage.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "circuit/device/constants.hpp"
#include "circuit/device/values.hpp"

namespace corpuscle::circuit {
namespace {

enum Terminal { D, G, S, B };

/// Nodes (numbers in the circuit) that some capacitor keeps and no voltage source holds.
std::set<int> kept_nodes(const Circuit& circuit) {
    std::set<int> out;
    for (const auto& e : circuit.elements)
        if (e.letter == 'c') out.insert(e.nodes.begin(), e.nodes.begin() + 2);
    out.erase(0);
    for (const auto& e : circuit.elements)
        if (e.letter == 'v')
            for (const int node : e.nodes) out.erase(node);
    return out;
}

/// The drain's current, gate at source: as of an NMOS, `forward` of the bulk above the source.
double drain_current(const Device& d, double polarity, double supply, double forward) {
    const double v[4] = {polarity * supply, 0, 0, polarity * forward};
    double f[4] = {}, q[4] = {}, df[16] = {}, dq[16] = {};
    Instant at;
    at.charges = false;
    d.eval(v, at, {f, q, df, dq});
    return std::abs(f[D]);
}

}  // namespace

std::vector<Leak> leaks_of(const System& system, std::span<const double> x, double supply) {
    std::vector<Leak> out;
    const auto& circuit = system.circuit();
    const auto kept = kept_nodes(circuit);
    for (std::size_t k = 0; k < circuit.elements.size(); ++k) {
        const auto& e = circuit.elements[k];
        if (e.letter != 'm') continue;
        const auto& d = *system.devices()[k];
        const double polarity = circuit.models[static_cast<std::size_t>(e.model)].type == "pmos" ? -1 : 1;
        const auto v = system.terminals(d, x);
        const double source = std::min(polarity * v[D], polarity * v[S]);
        Leak leak{k, drain_current(d, polarity, supply, std::max(polarity * v[B] - source, 0.0)), polarity * v[G] - source, false, ""};
        leak.off = leak.V_GS < thermal_voltage(circuit.temperature + zero_celsius);
        for (const auto end : {D, S})
            if (const int node = e.nodes[end]; leak.onto.empty() && kept.contains(node))
                leak.onto = circuit.nodes[static_cast<std::size_t>(node)];
        out.push_back(std::move(leak));
    }
    return out;
}

double smallest_bias(const Circuit& circuit) {
    double least = 0;
    for (const auto& e : circuit.elements) {
        if (e.letter != 'i' || e.waveform.shape == Waveform::Shape::force) continue;
        const double i = std::abs(e.waveform.dc * value_or(e.values, "m", 1));
        if (i > 0 && (least == 0 || i < least)) least = i;
    }
    return least;
}

}  // namespace corpuscle::circuit
