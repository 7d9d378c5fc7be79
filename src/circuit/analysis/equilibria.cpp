#include "circuit/analysis/equilibria.hpp"

#include <tuple>

#include "circuit/analysis/transient_setup.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double min_difference = 1e-3;  // V: equilibria are different if some node voltage differs by more

/// Collects equilibria without duplicates.
class EquilibriumSet {
    AnalysisContext& context_;
    std::vector<Equilibrium> found_;

    std::size_t nodes() const { return static_cast<std::size_t>(context_.system.nodes()); }

public:
    explicit EquilibriumSet(AnalysisContext& context) : context_(context) {
        context.newton.context.time = 0, context.newton.context.with_charges = false;
    }

    bool are_same(const std::vector<double>& a, const std::vector<double>& b) const {
        for (std::size_t n = 0; n < nodes(); ++n)
            if (std::abs(a[n] - b[n]) > min_difference) return false;
        return true;
    }
    /// Adds an equilibrium, or finds the one that is already in the set.
    Equilibrium& add(std::vector<double> x) {
        for (auto& s : found_)
            if (are_same(s.x, x)) return s;
        context_.newton.limiting_state = context_.system.initial_limiting_state();
        const bool stable = context_.system.is_linear() || !find_unstable_mode(context_.newton, x);
        context_.newton.context.with_charges = false;
        return found_.emplace_back(Equilibrium{std::move(x), stable});
    }
    /// Adds the equilibrium that a search from `start` finds; null if it finds none.
    Equilibrium* add_from(std::vector<double> start) {
        auto found = find_operating_point(context_.newton, std::move(start));
        return found ? &add(std::move(found->x)) : nullptr;
    }
    /// Searches from x with a node clamped to the voltage `to`, then from the result without the clamp.
    void add_from_clamped(const std::vector<double>& x, std::size_t node, double to) {
        context_.system.reset_states();
        NodeClamps clamps{std::vector<double>(nodes()), std::vector<double>(x.size())};
        clamps.conductance[node] = 1, clamps.voltage[node] = to;
        auto clamped = find_operating_point(context_.newton, x, clamps);
        if (clamped) (void)add_from(std::move(clamped->x));
    }
    /// A copy of the stable equilibria found so far.
    std::vector<std::vector<double>> stable() const {
        std::vector<std::vector<double>> out;
        for (const auto& s : found_)
            if (s.is_stable) out.push_back(s.x);
        return out;
    }
    /// Default, stable, unstable; the set is empty afterwards.
    std::vector<Equilibrium> take_sorted() {
        std::sort(found_.begin(), found_.end(), [](const Equilibrium& a, const Equilibrium& b) {
            return std::tuple(!a.is_default, !a.is_stable, a.x) < std::tuple(!b.is_default, !b.is_stable, b.x);
        });
        return std::move(found_);
    }
};

constexpr double settling_time = 1e5;  // s: length of the transient, after which the circuit has settled or oscillates

/// A copy of the circuit without .ic, whose sources rise from 0 to their DC values within `rise` (s).
std::shared_ptr<const Circuit> with_rising_sources(const AnalysisContext& context, double rise) {
    auto copy = std::make_shared<Circuit>(*context.circuit);
    copy->ic.clear();
    for (std::size_t k = 0; k < copy->elements.size(); ++k) {
        auto& e = copy->elements[k];
        if (!is_independent_source(e)) continue;
        e.waveform = Waveform{};
        e.waveform.shape = Waveform::Shape::piecewise_linear;
        e.waveform.numbers = {0, 0, rise, context.system.devices()[k]->principal_value().value_or(0)};
    }
    return copy;
}

/// The unknowns at the end of a transient that starts at 0 V everywhere, without .ic, while all V and I sources rise from 0 within `rise`
/// (s). The original circuit gets the states of its devices. Returns nothing if the circuit keeps oscillating.
Result<std::optional<std::vector<double>>> power_on_state(const AnalysisContext& original, double rise) {
    auto copy = TRY(AnalysisContext::make(with_rising_sources(original, rise)));
    auto& context = *copy;
    if (original.chip_sample()) context.system.apply_variation(&*original.chip_sample());
    auto plan = TRY(read_transient_plan(*context.circuit));
    plan.stop = settling_time, plan.max_step = settling_time / 50;
    context.system.start_transient(rise, settling_time);
    context.newton.context.time = 0, context.newton.context.with_charges = false;
    Transient transient(context.system, context.newton, plan);
    TRY(transient.begin(std::vector<double>(static_cast<std::size_t>(context.system.size())), false));
    constexpr long max_steps = 200'000;  // exceeded only by an oscillating circuit
    while (transient.time() < settling_time) {
        if (transient.stats().steps > max_steps) return std::optional<std::vector<double>>();
        if (auto stepped = transient.step(settling_time); !stepped)
            return stepped.error();
        else if (!*stepped)
            break;
    }
    original.system.set_states(context.system.states());
    return std::optional(std::vector<double>(transient.x().begin(), transient.x().end()));
}

/// The lowest and the highest of 0 V and the DC values of all voltage sources.
std::pair<double, double> supply_range(const AnalysisContext& context) {
    double low = 0, high = 0;
    const auto& elements = context.circuit->elements;
    for (std::size_t k = 0; k < elements.size(); ++k)
        if (has_role(elements[k], Role::voltage_source)) {
            const double v = context.system.devices()[k]->principal_value().value_or(0);
            low = std::min(low, v), high = std::max(high, v);
        }
    return {low, high};
}

/// The nodes (indices of unknowns) whose voltages differ by more than 1 mV between two equilibria, the largest difference first.
std::vector<std::size_t> differing_nodes(const AnalysisContext& context, const Equilibrium& a, const Equilibrium& b) {
    const auto difference = [&](std::size_t n) { return std::abs(a.x[n] - b.x[n]); };
    std::vector<std::size_t> out;
    for (std::size_t n = 0; n < static_cast<std::size_t>(context.system.nodes()); ++n)
        if (difference(n) > min_difference) out.push_back(n);
    std::sort(out.begin(), out.end(),
              [&](std::size_t m, std::size_t n) { return std::pair(-difference(m), m) < std::pair(-difference(n), n); });
    return out;
}

}  // namespace

Result<std::vector<Equilibrium>> find_equilibria(AnalysisContext& context, double rise) {
    const auto operating_point = TRY(context.operating_point());
    EquilibriumSet states(context);
    states.add(operating_point.x).is_default = true;
    if (context.system.is_linear()) return states.take_sorted();
    const auto [low, high] = supply_range(context);
    for (std::size_t n = 0; n < static_cast<std::size_t>(context.system.nodes()); ++n) {
        if (context.is_stopped(static_cast<double>(n) / context.system.nodes())) return interrupted_error();
        for (const double end : {low, high})
            if (std::abs(operating_point.x[n] - end) > min_difference) states.add_from_clamped(operating_point.x, n, end);
    }
    const auto power_on = power_on_state(context, rise);
    if (power_on && *power_on)
        if (auto* reached = states.add_from(**power_on)) reached->is_power_on = true;
    const auto stable = states.stable();
    context.system.reset_states();
    for (std::size_t a = 0; a < stable.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            auto midpoint = stable[a];
            for (std::size_t n = 0; n < midpoint.size(); ++n) midpoint[n] = (midpoint[n] + stable[b][n]) / 2;
            (void)states.add_from(std::move(midpoint));
        }
    return states.take_sorted();
}

std::string describe(const AnalysisContext& context, const std::vector<Equilibrium>& states) {
    constexpr std::size_t max_nodes = 6;
    std::string out;
    for (const auto& s : states) {
        out += fmt::format("state {}: {}{}{}\n", &s - states.data() + 1, s.is_stable ? "stable" : "unstable",
                           s.is_default ? ", the state of .op" : "", s.is_power_on ? ", the state after power-on" : "");
        if (&s == states.data()) continue;
        const auto nodes = differing_nodes(context, states[0], s);
        for (std::size_t k = 0; k < std::min(max_nodes, nodes.size()); ++k)
            out += fmt::format("  {:24} {:>12}, in state 1 {:>12}\n", context.system.names()[nodes[k]], format_quantity(s.x[nodes[k]], "V"),
                               format_quantity(states[0].x[nodes[k]], "V"));
        if (nodes.size() > max_nodes) out += fmt::format("  and {} more nodes that differ by more than 1 mV\n", nodes.size() - max_nodes);
    }
    return out;
}

}  // namespace corpuscle::circuit
