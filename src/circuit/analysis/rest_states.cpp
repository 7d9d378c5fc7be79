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

constexpr double apart = 1e-3;  // V: from there on states are two

/// Collects states as they are found.
class States {
    TestBench& bench_;
    std::vector<RestState> found_;

    std::size_t nodes() const { return static_cast<std::size_t>(bench_.system.nodes()); }

public:
    explicit States(TestBench& bench) : bench_(bench) { bench.newton.instant.time = 0, bench.newton.instant.charges = false; }

    bool same(const std::vector<double>& a, const std::vector<double>& b) const {
        for (std::size_t n = 0; n < nodes(); ++n)
            if (std::abs(a[n] - b[n]) > apart) return false;
        return true;
    }
    RestState& add(std::vector<double> x) {
        for (auto& s : found_)
            if (same(s.x, x)) return s;
        bench_.newton.memory = bench_.system.fresh_memory();
        const bool stable = bench_.system.linear() || !growth_at(bench_.newton, x);
        bench_.newton.instant.charges = false;
        return found_.emplace_back(RestState{std::move(x), stable});
    }
    RestState* from(std::vector<double> start) {
        auto found = operating_point(bench_.newton, std::move(start));
        return found ? &add(std::move(found->x)) : nullptr;
    }
    /// With a node pushed to a voltage until all else has followed, then let go.
    void pushed(const std::vector<double>& x, std::size_t node, double to) {
        Springs springs{std::vector<double>(nodes()), std::vector<double>(x.size())};
        springs.g[node] = 1, springs.to[node] = to;
        auto held = operating_point(bench_.newton, x, springs);
        if (held) (void)from(std::move(held->x));
    }
    /// Of the stable ones found so far by number: a copy, as more may come.
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

/// The voltages between which sources hold what they hold: ground, and the highest and lowest of them.
std::pair<double, double> rails(const TestBench& bench) {
    double low = 0, high = 0;
    const auto& elements = bench.circuit->elements;
    for (std::size_t k = 0; k < elements.size(); ++k)
        if (elements[k].letter == 'v') {
            const double v = bench.system.devices()[k]->setting().value_or(0);
            low = std::min(low, v), high = std::max(high, v);
        }
    return {low, high};
}

}  // namespace

Result<std::vector<RestState>> rest_states(TestBench& bench, double rise) {
    const auto usual = bench.rest();
    if (!usual) return usual.error();
    States states(bench);
    states.add(usual->x).usual = true;
    if (bench.system.linear()) return states.take();
    const auto [low, high] = rails(bench);
    for (std::size_t n = 0; n < static_cast<std::size_t>(bench.system.nodes()); ++n) {
        if (bench.stopped(static_cast<double>(n) / bench.system.nodes())) return interruption();
        for (const double end : {low, high})
            if (std::abs(usual->x[n] - end) > apart) states.pushed(usual->x, n, end);
    }
    const auto on = powered_on(bench, rise);
    if (on && *on)
        if (auto* there = states.from(**on)) there->power_on = true;
    const auto stable = states.stable();
    for (std::size_t a = 0; a < stable.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            auto between = stable[a];
            for (std::size_t n = 0; n < between.size(); ++n) between[n] = (between[n] + stable[b][n]) / 2;
            (void)states.from(std::move(between));
        }
    return states.take();
}

std::vector<std::size_t> differing(const TestBench& bench, const RestState& a, const RestState& b) {
    const auto off = [&](std::size_t n) { return std::abs(a.x[n] - b.x[n]); };
    std::vector<std::size_t> out;
    for (std::size_t n = 0; n < static_cast<std::size_t>(bench.system.nodes()); ++n)
        if (off(n) > apart) out.push_back(n);
    std::sort(out.begin(), out.end(), [&](std::size_t m, std::size_t n) { return std::pair(-off(m), m) < std::pair(-off(n), n); });
    return out;
}

std::string told(const TestBench& bench, const std::vector<RestState>& states) {
    constexpr std::size_t most = 6;  // nodes
    std::string out;
    for (const auto& s : states) {
        out += fmt::format("state {}: {}{}{}\n", &s - states.data() + 1, s.stable ? "stable" : "not stable",
                           s.usual ? ", where .op rests" : "", s.power_on ? ", where it comes to when it is switched on" : "");
        if (&s == states.data()) continue;
        const auto nodes = differing(bench, states[0], s);
        for (std::size_t k = 0; k < std::min(most, nodes.size()); ++k)
            out += fmt::format("  {:24} {:>12}, in state 1 {:>12}\n", bench.system.names()[nodes[k]], format_quantity(s.x[nodes[k]], "V"),
                               format_quantity(states[0].x[nodes[k]], "V"));
        if (nodes.size() > most) out += fmt::format("  and {} more nodes by more than a millivolt\n", nodes.size() - most);
    }
    return out;
}

}  // namespace corpuscle::circuit
