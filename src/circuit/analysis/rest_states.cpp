#include "circuit/analysis/rest_states.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "circuit/analysis/power_on.hpp"
#include "circuit/solve/stability.hpp"
#include "signal/quantity.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double min_difference = 1e-3;  // V, between two equilibria

/// Collects equilibria without duplicates.
class EquilibriumSet {
    TestBench& context_;
    std::vector<RestState> found_;

    std::size_t nodes() const { return static_cast<std::size_t>(context_.system.nodes()); }

public:
    explicit EquilibriumSet(TestBench& context) : context_(context) {
        context.newton.instant.time = 0, context.newton.instant.charges = false;
    }

    bool same(const std::vector<double>& a, const std::vector<double>& b) const {
        for (std::size_t n = 0; n < nodes(); ++n)
            if (std::abs(a[n] - b[n]) > min_difference) return false;
        return true;
    }
    RestState& add(std::vector<double> x) {
        for (auto& s : found_)
            if (same(s.x, x)) return s;
        context_.newton.memory = context_.system.fresh_memory();
        const bool stable = context_.system.linear() || !growth_at(context_.newton, x);
        context_.newton.instant.charges = false;
        return found_.emplace_back(RestState{std::move(x), stable});
    }
    RestState* add_from(std::vector<double> start) {
        auto found = operating_point(context_.newton, std::move(start));
        return found ? &add(std::move(found->x)) : nullptr;
    }
    /// Searches with a node clamped to a voltage, then from there without the clamp.
    void add_from_clamped(const std::vector<double>& x, std::size_t node, double to) {
        Springs clamps{std::vector<double>(nodes()), std::vector<double>(x.size())};
        clamps.g[node] = 1, clamps.to[node] = to;
        auto clamped = operating_point(context_.newton, x, clamps);
        if (clamped) (void)add_from(std::move(clamped->x));
    }
    /// A copy of the stable equilibria found so far.
    std::vector<std::vector<double>> stable() const {
        std::vector<std::vector<double>> out;
        for (const auto& s : found_)
            if (s.stable) out.push_back(s.x);
        return out;
    }
    std::vector<RestState> take() {
        std::sort(found_.begin(), found_.end(), [](const RestState& a, const RestState& b) {
            return std::tuple(!a.usual, !a.stable, a.x) < std::tuple(!b.usual, !b.stable, b.x);
        });
        return std::move(found_);
    }
};

/// The lowest and the highest voltage of ground and all voltage sources.
std::pair<double, double> supply_range(const TestBench& context) {
    double low = 0, high = 0;
    const auto& elements = context.circuit->elements;
    for (std::size_t k = 0; k < elements.size(); ++k)
        if (elements[k].letter == 'v') {
            const double v = context.system.devices()[k]->setting().value_or(0);
            low = std::min(low, v), high = std::max(high, v);
        }
    return {low, high};
}

}  // namespace

Result<std::vector<RestState>> rest_states(TestBench& context, double rise) {
    const auto operating_point = context.rest();
    if (!operating_point) return operating_point.error();
    EquilibriumSet states(context);
    states.add(operating_point->x).usual = true;
    if (context.system.linear()) return states.take();
    const auto [low, high] = supply_range(context);
    for (std::size_t n = 0; n < static_cast<std::size_t>(context.system.nodes()); ++n) {
        if (context.stopped(static_cast<double>(n) / context.system.nodes())) return interruption();
        for (const double end : {low, high})
            if (std::abs(operating_point->x[n] - end) > min_difference) states.add_from_clamped(operating_point->x, n, end);
    }
    const auto power_on = powered_on(context, rise);
    if (power_on && *power_on)
        if (auto* reached = states.add_from(**power_on)) reached->power_on = true;
    const auto stable = states.stable();
    for (std::size_t a = 0; a < stable.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            auto between = stable[a];
            for (std::size_t n = 0; n < between.size(); ++n) between[n] = (between[n] + stable[b][n]) / 2;
            (void)states.add_from(std::move(between));
        }
    return states.take();
}

std::vector<std::size_t> differing(const TestBench& context, const RestState& a, const RestState& b) {
    const auto difference = [&](std::size_t n) { return std::abs(a.x[n] - b.x[n]); };
    std::vector<std::size_t> out;
    for (std::size_t n = 0; n < static_cast<std::size_t>(context.system.nodes()); ++n)
        if (difference(n) > min_difference) out.push_back(n);
    std::sort(out.begin(), out.end(),
              [&](std::size_t m, std::size_t n) { return std::pair(-difference(m), m) < std::pair(-difference(n), n); });
    return out;
}

std::string told(const TestBench& context, const std::vector<RestState>& states) {
    constexpr std::size_t max_nodes = 6;
    std::string out;
    for (const auto& s : states) {
        out += fmt::format("state {}: {}{}{}\n", &s - states.data() + 1, s.stable ? "stable" : "unstable",
                           s.usual ? ", the state of .op" : "", s.power_on ? ", the state after power-on" : "");
        if (&s == states.data()) continue;
        const auto nodes = differing(context, states[0], s);
        for (std::size_t k = 0; k < std::min(max_nodes, nodes.size()); ++k)
            out += fmt::format("  {:24} {:>12}, in state 1 {:>12}\n", context.system.names()[nodes[k]], format_quantity(s.x[nodes[k]], "V"),
                               format_quantity(states[0].x[nodes[k]], "V"));
        if (nodes.size() > max_nodes) out += fmt::format("  and {} more nodes that differ by more than 1 mV\n", nodes.size() - max_nodes);
    }
    return out;
}

}  // namespace corpuscle::circuit
