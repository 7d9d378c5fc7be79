#include "circuit/cost/power.hpp"

#include "circuit/devices.hpp"

namespace corpuscle::circuit {
namespace {

constexpr std::string_view top_level = "top level";

/// The subcircuit of the top level in which an element or node with this name is; "" if it is in none.
std::string_view subcircuit_of(std::string_view name) {
    const auto dot = name.find('.');
    return dot == std::string_view::npos || dot == 0 ? "" : name.substr(1, dot - 1);
}

/// The name of the block to which an element belongs.
std::string block_of(const Element& e) {
    const auto subcircuit = subcircuit_of(e.name);
    if (!subcircuit.empty()) return std::string(subcircuit);
    return has_role(e, Role::current_source) ? "ideal currents" : std::string(top_level);
}

bool is_force_source(const Element& e) { return e.waveform.shape == Waveform::Shape::force; }

/// Unknowns of the nodes of FORCE voltage sources.
std::vector<int> force_nodes(const System& system) {
    std::vector<int> out;
    const auto& elements = system.circuit().elements;
    for (std::size_t k = 0; k < elements.size(); ++k)
        if (has_role(elements[k], Role::voltage_source) && is_force_source(elements[k]))
            for (const int node : std::span(system.devices()[k]->unknowns).first(2))
                if (node >= 0) out.push_back(node);
    return out;
}

/// True for a current source with an expression that reads one of these nodes.
bool is_sensor(const Element& e, const Device& d, std::span<const int> nodes) {
    if (!is_current_expression(e)) return false;
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

std::string Blocks::name_of_node(std::string_view node) {
    const auto subcircuit = subcircuit_of(node);
    return std::string(subcircuit.empty() ? top_level : subcircuit);
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
        if (!is_independent_source(e)) continue;
        double dissipated = 0;
        current(k, x, 0, dissipated);
        if (has_role(e, Role::current_source) && !is_force_source(e) && dissipated >= 0) continue;
        role_.back() = static_cast<int>(sources_.size());
        sources_.push_back(k);
        if (!has_role(e, Role::voltage_source) || is_force_source(e) || -dissipated <= max_delivered) continue;
        max_delivered = -dissipated;
        const auto v = system.terminal_values(*system.devices()[k], x);
        supply_ = std::abs(v[0] - v[1]);
    }
}

/// The current (A) into the first node of device k; `power` receives the sum of v i over all its nodes, W.
double PowerMeter::current(std::size_t k, std::span<const double> x, double t, double& power) const {
    const auto& d = *system_.devices()[k];
    v_.resize(d.unknowns.size());
    for (std::size_t u = 0; u < v_.size(); ++u) v_[u] = value_of(x, d.unknowns[u]);
    EvalContext context;
    context.time = t, context.gmin = gmin_, context.with_charges = false;
    const auto f = stamp_.eval(d, v_, context).f;
    power = 0;
    for (std::size_t u = 0; u < f.size(); ++u)
        if (d.unknowns[u] >= 0 && system_.is_voltage(d.unknowns[u])) power += v_[u] * f[u];
    return f[0];
}

PowerBreakdown PowerMeter::power_at(std::span<const double> x, double t) const {
    PowerBreakdown out;
    out.sources.resize(sources_.size()), out.blocks.resize(blocks_.names.size());
    double power = 0;
    for (std::size_t k = 0; k < role_.size(); ++k) {
        if (has_role(system_.circuit().elements[k], Role::inductor)) continue;  // inductors store energy, they do not dissipate it
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
    for (const auto k : sources_) {
        const auto& u = system_.devices()[k]->unknowns;
        if (u.size() == 3)  // a voltage source; its current is an unknown
            power = (value_of(x, u[0]) - value_of(x, u[1])) * value_of(x, u[2]);
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

std::vector<double> PowerMeter::source_currents(std::span<const double> x, double t) const {
    std::vector<double> out;
    double power = 0;
    for (const auto k : sources_) {
        const auto& u = system_.devices()[k]->unknowns;
        out.push_back(u.size() == 3 ? value_of(x, u[2]) : current(k, x, t, power));  // that of a voltage source is an unknown
    }
    return out;
}

std::vector<PowerMeter::DeviceCurrent> PowerMeter::device_currents(std::span<const double> x, double t) const {
    std::vector<DeviceCurrent> out;
    double power = 0;
    for (std::size_t k = 0; k < role_.size(); ++k)
        if (role_[k] < 0) out.push_back({system_.devices()[k]->name, static_cast<std::size_t>(-1 - role_[k]), current(k, x, t, power)});
    return out;
}

Result<void> PowerOverTime::begin(const Plot&) {
    sums_.assign(phases_.size() + 1, {});
    times_.assign(phases_.size() + 1, 0);
    peak_ = {}, has_points_ = false;
    return {};
}

Result<void> PowerOverTime::add_point(const PlotRow& row) {
    const double t = row.real[0];
    auto now = meter_.power_at(row.real.subspan(1), t);
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
