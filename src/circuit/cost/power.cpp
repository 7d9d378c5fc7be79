#include "circuit/cost/power.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle::circuit {
namespace {

/// The name of the block to which an element belongs.
std::string block_of(const Element& e) {
    const auto dot = e.name.find('.');
    if (dot != std::string::npos) return e.name.substr(1, dot - 1);
    return e.letter == 'i' ? "ideal currents" : "top level";
}

bool is_force_source(const Element& e) { return e.waveform.shape == Waveform::Shape::force; }
bool is_independent(const Element& e) { return e.letter == 'v' || e.letter == 'i'; }

/// Unknowns of the nodes of FORCE voltage sources.
std::vector<int> force_nodes(const System& system) {
    std::vector<int> out;
    const auto& elements = system.circuit().elements;
    for (std::size_t k = 0; k < elements.size(); ++k)
        if (elements[k].letter == 'v' && is_force_source(elements[k]))
            for (const int node : std::span(system.devices()[k]->unknowns).first(2))
                if (node >= 0) out.push_back(node);
    return out;
}

/// True for a current source with an expression that reads one of these nodes.
bool is_sensor(const Element& e, const Device& d, std::span<const int> nodes) {
    if (!e.expression || e.expression_is_voltage || (e.letter != 'b' && e.letter != 'g')) return false;
    // The first two unknowns are the nodes of the source itself; the others are read by the expression.
    return std::any_of(d.unknowns.begin() + 2, d.unknowns.end(),
                       [&](int u) { return std::find(nodes.begin(), nodes.end(), u) != nodes.end(); });
}

/// Calls f(x, y) for each number x of `a` and the corresponding number y of `b`.
template <class F>
void for_each_power(PowerBreakdown& a, const PowerBreakdown& b, F f) {
    f(a.supplies, b.supplies), f(a.sensor, b.sensor), f(a.without_sensor, b.without_sensor);
    a.sources.resize(b.sources.size()), a.blocks.resize(b.blocks.size());
    for (std::size_t k = 0; k < b.sources.size(); ++k) f(a.sources[k], b.sources[k]);
    for (std::size_t k = 0; k < b.blocks.size(); ++k) f(a.blocks[k], b.blocks[k]);
}

}  // namespace

Blocks::Blocks(const Circuit& circuit) {
    for (const auto& e : circuit.elements) {
        const auto name = block_of(e);
        const auto at = std::find(names.begin(), names.end(), name);
        block_of_element.push_back(static_cast<std::size_t>(at - names.begin()));
        if (at == names.end()) names.push_back(name);
    }
}

PowerMeter::PowerMeter(const System& system, std::span<const double> x, double gmin)
    : system_(system), gmin_(gmin), blocks_(system.circuit()) {
    const auto& elements = system.circuit().elements;
    const auto force = force_nodes(system);
    double max_delivered = -INFINITY;
    for (std::size_t k = 0; k < elements.size(); ++k) {
        const auto& e = elements[k];
        role_.push_back(-1 - static_cast<int>(blocks_.block_of_element[k]));
        if (is_sensor(e, *system.devices()[k], force)) sensors_.push_back(k);
        if (!is_independent(e)) continue;
        double dissipated = 0;
        current(k, x, 0, dissipated);
        if (e.letter == 'i' && !is_force_source(e) && dissipated >= 0) continue;
        role_.back() = static_cast<int>(sources_.size());
        sources_.push_back(k);
        if (e.letter != 'v' || is_force_source(e) || -dissipated <= max_delivered) continue;
        max_delivered = -dissipated;
        const auto v = system.terminal_values(*system.devices()[k], x);
        supply_ = std::abs(v[0] - v[1]);
    }
}

/// The current (A) into the first node of device k; `power` receives the sum of v i over all its nodes, W.
double PowerMeter::current(std::size_t k, std::span<const double> x, double t, double& power) const {
    const auto& d = *system_.devices()[k];
    const auto n = d.unknowns.size();
    v_.resize(n);
    for (std::size_t u = 0; u < n; ++u) v_[u] = d.unknowns[u] < 0 ? 0 : x[static_cast<std::size_t>(d.unknowns[u])];
    for (auto* currents : {&f_, &q_}) currents->assign(n, 0);
    for (auto* derivatives : {&df_, &dq_}) derivatives->assign(n * n, 0);
    EvalContext context;
    context.time = t, context.gmin = gmin_, context.with_charges = false;
    d.eval(v_, context, {f_, q_, df_, dq_});
    power = 0;
    for (std::size_t u = 0; u < n; ++u)
        if (d.unknowns[u] >= 0 && system_.is_voltage(d.unknowns[u])) power += v_[u] * f_[u];
    return f_[0];
}

PowerBreakdown PowerMeter::power_at(std::span<const double> x, double t) const {
    PowerBreakdown out;
    out.sources.resize(sources_.size()), out.blocks.resize(blocks_.names.size());
    double power = 0;
    for (std::size_t k = 0; k < role_.size(); ++k) {
        if (system_.circuit().elements[k].letter == 'l') continue;  // inductors store energy, they do not dissipate it
        current(k, x, t, power);
        if (role_[k] >= 0)
            out.sources[static_cast<std::size_t>(role_[k])] = -power;
        else
            out.blocks[static_cast<std::size_t>(-1 - role_[k])] += power;
    }
    for (const double p : out.sources) out.supplies += p;
    for (const auto k : sensors_) out.sensor += std::abs(current(k, x, t, power)) * supply_;
    out.without_sensor = out.supplies - out.sensor;
    return out;
}

PowerMeter::DeliveredPower PowerMeter::delivered_at(std::span<const double> x, double t) const {
    DeliveredPower out;
    double power = 0;
    const auto at = [&](int unknown) { return unknown < 0 ? 0 : x[static_cast<std::size_t>(unknown)]; };
    for (const auto k : sources_) {
        const auto& u = system_.devices()[k]->unknowns;
        if (u.size() == 3)  // a voltage source; its current is an unknown
            power = (at(u[0]) - at(u[1])) * at(u[2]);
        else
            current(k, x, t, power);
        out.supplies -= power;
    }
    for (const auto k : sensors_) out.sensor += std::abs(current(k, x, t, power)) * supply_;
    return out;
}

std::vector<std::string> PowerMeter::sources() const {
    std::vector<std::string> out;
    for (const auto k : sources_) out.push_back(system_.devices()[k]->name);
    return out;
}

Result<void> PowerOverTime::begin(const Plot&) {
    sums_.assign(phases_.size() + 1, {});
    times_.assign(phases_.size() + 1, 0);
    peak_ = {}, has_points_ = false;
    return {};
}

Result<void> PowerOverTime::add_point(std::span<const double> row) {
    const double t = row[0];
    auto now = meter_.power_at(row.subspan(1), t);
    if (!std::exchange(has_points_, true)) {
        peak_ = now;
    } else {
        for (std::size_t p = 0; p < sums_.size(); ++p) {
            const double from = p == 0 ? t_ : std::max(t_, phases_[p - 1].from), to = p == 0 ? t : std::min(t, phases_[p - 1].to);
            if (!(to > from)) continue;
            const double fraction = ((from + to) / 2 - t_) / (t - t_);  // power is linear between points: the mean is at the middle
            for_each_power(sums_[p], previous_, [&](double& sum, double b) { sum += (to - from) * (1 - fraction) * b; });
            for_each_power(sums_[p], now, [&](double& sum, double n) { sum += (to - from) * fraction * n; });
            times_[p] += to - from;
        }
        for_each_power(peak_, now, [](double& peak, double n) { peak = std::max(peak, n); });
    }
    previous_ = std::move(now), t_ = t;
    return {};
}

std::vector<std::pair<std::string, PowerBreakdown>> PowerOverTime::averages() const {
    std::vector<std::pair<std::string, PowerBreakdown>> out;
    if (!has_points_) return out;
    for (std::size_t p = 0; p < sums_.size(); ++p) {
        if (!(times_[p] > 0)) continue;
        PowerBreakdown mean;
        for_each_power(mean, sums_[p], [&](double& m, double sum) { m = sum / times_[p]; });
        out.emplace_back(p == 0 ? "mean" : phases_[p - 1].name, std::move(mean));
        if (p == 0) out.emplace_back("peak", peak_);
    }
    return out;
}

}  // namespace corpuscle::circuit
