#include "circuit/cost/cost.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "circuit/device/values.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double worth_telling = 0.1;  // of the smallest bias current

bool is_receptor(const Circuit& circuit) {
    const auto& elements = circuit.elements;
    return std::any_of(elements.begin(), elements.end(), [](const auto& e) { return e.waveform.shape == Waveform::Shape::force; }) &&
           std::any_of(circuit.commands.begin(), circuit.commands.end(), [](const auto& c) { return c.name == "spike"; });
}

bool has_no_size(const Element& e) { return e.letter == 'r' || e.letter == 'l' || e.letter == 'd' || (e.letter == 'c' && e.formula); }

void count(const Circuit& circuit, const Blocks& blocks, Cost& out) {
    for (const auto& name : blocks.names) out.blocks.push_back({name, 0, 0, {}, {}, ""});
    for (std::size_t k = 0; k < circuit.elements.size(); ++k) {
        const auto& e = circuit.elements[k];
        auto& block = out.blocks[blocks.of[k]];
        block.area += area_of(e);
        out.unsized += has_no_size(e);
        if (e.letter != 'm') continue;
        ++block.transistors;
        block.units += static_cast<std::size_t>(std::ceil(value_or(e.values, "m", 1) * value_or(e.values, "stack", 1)));
    }
}

void leak(const TestBench& bench, std::span<const double> x, const Blocks& blocks, Cost& out) {
    const auto& circuit = *bench.circuit;
    out.smallest_bias = smallest_bias(circuit);
    for (auto& one : leaks_of(bench.system, x, out.supply)) {
        auto& block = out.blocks[blocks.of[one.element]];
        if (block.worst_name.empty() || one.current > block.worst.current)
            block.worst = one, block.worst_name = circuit.elements[one.element].name;
        if (one.off && out.smallest_bias > 0 && one.current > worth_telling * out.smallest_bias) out.leaks.push_back(std::move(one));
    }
    std::sort(out.leaks.begin(), out.leaks.end(), [](const Leak& a, const Leak& b) {
        return std::tuple(a.onto.empty(), -a.current, a.element) < std::tuple(b.onto.empty(), -b.current, b.element);
    });
    for (const auto& one : out.leaks) out.leaking.push_back(circuit.elements[one.element].name);
}

}  // namespace

Area Cost::area() const {
    Area all;
    for (const auto& b : blocks) all += b.area;
    return all;
}

const Powers* Cost::powers(std::string_view of) const {
    for (const auto& [name, powers] : power)
        if (name == of) return &powers;
    return nullptr;
}

Result<Cost> cost_of(TestBench& bench, const PowerOverTime* over) {
    const auto rest = bench.rest();
    if (!rest) return rest.error();
    const PowerMeter meter(bench.system, rest->x, bench.tolerances.gmin);
    Cost out;
    out.supply = meter.supply(), out.sources = meter.sources(), out.has_sensor = meter.has_sensor();
    out.is_receptor = is_receptor(*bench.circuit);
    count(*bench.circuit, meter.blocks(), out);
    leak(bench, rest->x, meter.blocks(), out);
    out.power.emplace_back("op", meter.at(rest->x));
    if (over)
        for (auto& one : over->told()) out.power.push_back(std::move(one));
    return out;
}

}  // namespace corpuscle::circuit
