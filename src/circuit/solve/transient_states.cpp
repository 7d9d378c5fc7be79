// Changes of the states of devices, such as switches, in a transient.

#include "circuit/solve/transient.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle::circuit {

/// Changes the states of the devices whose controls are beyond their levels at the newest point. For an afferent, the unknowns without
/// charge are computed again, which may change other states. In .tran a very short step gives their values after the change.
Result<void> Transient::change_states() {
    constexpr double same_time = 1e-6;  // relative to the longest step; more than a step after a breakpoint
    constexpr int max_changes = 1000;
    while (const Device* changed = system_.change_states(history_points_[0].x)) {
        changes_at_once_ = time() - last_change_ <= same_time * plan_.max_step ? changes_at_once_ + 1 : 0, last_change_ = time();
        if (changes_at_once_ > max_changes)
            return Error{ErrorCode::not_converged,
                         fmt::format("transient stopped at {}: {} changes its state again and again, since each state leads to the other; "
                                     "give it hysteresis, or the node of its control a capacitor",
                                     format_quantity(time(), "s"), changed->name),
                         changed->location};
        restart_pending_ = true;
        if (noise_) noise_->update(history_points_[0].x, true);
        if (plan_.all_reported) return start_phase_ = StartPhase::breakpoint, Result<void>();
        TRY(make_consistent());
    }
    return {};
}

/// By device with states: how far its control may be beyond the level when its state changes, V or A. Far below the allowed error.
std::vector<double> Transient::state_tolerances() const {
    constexpr double fraction = 0.01;
    std::vector<double> out;
    for (const auto k : system_.devices_with_states()) {
        const auto& d = *system_.devices()[k];
        const auto change = *d.next_change();
        const auto tolerance = [&](std::size_t u) { return d.unknowns[u] < 0 ? 0 : tolerance_[static_cast<std::size_t>(d.unknowns[u])]; };
        out.push_back(fraction * std::max(tolerance(change.plus), change.minus ? tolerance(*change.minus) : 0));
    }
    return out;
}

/// True if a device changes its state within the step just solved, so that the step must be solved again with another end.
bool Transient::must_locate_change() {
    constexpr double shortest = 1e-9, shortest_of_time = 1e-12;  // interval that need not be divided, relative to the longest step; to t
    const auto& next = history_points_.next_point();
    const auto tolerances = state_tolerances();
    if (state_change_.must_try_again(next.t, next.x, std::max(shortest * plan_.max_step, shortest_of_time * next.t), tolerances))
        return true;
    if (state_change_.trial()) return false;
    // A control may pass its level and return within a step.
    const int points = std::min(3, history_points_.smooth_count());
    std::array<double, History::max_points + 1> times{next.t};
    const auto before = history_points_.times();
    std::copy(before.begin(), before.end(), times.begin() + 1);
    std::vector<double> x(next.x.size());
    for (const double part : {0.25, 0.5, 0.75}) {
        const double t = times[1] + part * (next.t - times[1]);
        const auto w = weights_of_value(std::span(times).first(static_cast<std::size_t>(points) + 1), t);
        for (std::size_t n = 0; n < x.size(); ++n) {
            x[n] = w[0] * next.x[n];
            for (int k = 0; k < points; ++k) x[n] += w[static_cast<std::size_t>(k) + 1] * history_points_[k].x[n];
        }
        for (const auto& node : source_nodes_) x[static_cast<std::size_t>(node.unknown)] = source_node_voltage(node, t);
        if (state_change_.changes_within(t, x, tolerances)) return true;
    }
    return false;
}

}  // namespace corpuscle::circuit
