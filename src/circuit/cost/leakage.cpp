#include "circuit/cost/leakage.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "circuit/device/constants.hpp"
#include "circuit/device/values.hpp"

namespace corpuscle::circuit {
namespace {

enum Terminal { D, G, S, B };

/// The nodes of a circuit, those as one that sources of 0 V (by which currents are seen) join.
class Joined {
    std::vector<int> of_;

public:
    explicit Joined(const Circuit& circuit) : of_(circuit.nodes.size()) {
        std::iota(of_.begin(), of_.end(), 0);
        for (const auto& e : circuit.elements) {
            if (!is_wire(e)) continue;
            const int first = of(e.nodes[0]), second = of(e.nodes[1]);
            std::replace(of_.begin(), of_.end(), std::max(first, second), std::min(first, second));
        }
    }
    static bool is_wire(const Element& e) {
        return e.letter == 'v' && e.waveform.dc == 0 && e.waveform.shape == Waveform::Shape::none && e.waveform.ac_magnitude == 0;
    }
    int of(int node) const { return of_[static_cast<std::size_t>(node)]; }
};

/// Nodes that some capacitor keeps and no voltage source holds: by which of the joined ones each is, the capacitor's own node.
std::map<int, int> kept_nodes(const Circuit& circuit, const Joined& joined) {
    std::map<int, int> out;
    for (const auto& e : circuit.elements)
        if (e.letter == 'c')
            for (int k = 0; k < 2; ++k) out.emplace(joined.of(e.nodes[static_cast<std::size_t>(k)]), e.nodes[static_cast<std::size_t>(k)]);
    out.erase(0);
    for (const auto& e : circuit.elements)
        if (e.letter == 'v' && !Joined::is_wire(e))
            for (const int node : e.nodes) out.erase(joined.of(node));
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
    const Joined joined(circuit);
    const auto kept = kept_nodes(circuit, joined);
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
            if (const auto node = kept.find(joined.of(e.nodes[end])); leak.onto.empty() && node != kept.end())
                leak.onto = circuit.nodes[static_cast<std::size_t>(node->second)];
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
