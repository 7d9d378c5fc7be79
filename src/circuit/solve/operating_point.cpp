#include "circuit/solve/operating_point.hpp"

#include <cmath>
#include <limits>

#include "circuit/device/named_values.hpp"
#include "circuit/devices.hpp"

namespace corpuscle::circuit {
namespace {

/// Searches for the operating point with one method after another.
class OperatingPointSearch {
    NewtonSolver& newton_;
    const System& system_;
    bool has_guess_;                    // the start is near the solution; .nodeset is then ignored
    std::vector<double> start_, last_;  // last_: last iterate of Newton's method without continuation, if it failed
    std::size_t nodes_;
    NodeClamps clamps_;  // clamps that are part of the solved circuit

    /// Clamps of g (S) from every node to the voltages `to`. A node in clamps_ keeps that clamp.
    NodeClamps clamp_all(double g, const std::vector<double>& to) const {
        NodeClamps out{std::vector<double>(nodes_, g), to};
        for (std::size_t n = 0; n < clamps_.conductance.size(); ++n)
            if (clamps_.conductance[n] > 0) out.conductance[n] = clamps_.conductance[n], out.voltage[n] = clamps_.voltage[n];
        return out;
    }

    /// Newton's method from x. Returns true and moves x to the solution if it is found; otherwise changes nothing.
    bool advance(std::vector<double>& x, const NodeClamps& clamps, int max_iterations) {
        auto next = x;
        const auto saved_limiting_state = newton_.limiting_state;
        if (newton_.solve(next, clamps, max_iterations)) return x = std::move(next), true;
        newton_.limiting_state = saved_limiting_state;
        return false;
    }

    // The methods: each starts from x. If it returns true, x is the solution.
    bool plain_newton(std::vector<double>& x) {
        constexpr int max_from_guess = 40;  // iterations: from a good guess, Newton's method converges within half as many, or diverges
        newton_.limiting_state = system_.initial_limiting_state();
        return newton_.solve(x, clamps_, has_guess_ ? std::min(max_from_guess, newton_.tolerances.itl1) : 0);
    }

    /// gmin stepping: a conductance from every node to ground, reduced decade by decade.
    bool gmin_stepping(std::vector<double>& x) {
        const std::vector<double> ground(x.size());
        double g = 1e-2, factor = 10;  // S; g is divided by the factor
        newton_.limiting_state = system_.initial_limiting_state();
        for (int tries = 0; tries < 200; ++tries) {
            if (advance(x, clamp_all(g, ground), 50)) {
                if (g < 1e-15) return newton_.solve(x, clamps_);
                g /= factor, factor = std::min(factor * 1.5, 10.0);
            } else {
                if (factor < 1.001) return false;
                g *= factor, factor = std::sqrt(factor), g /= factor;
            }
        }
        return false;
    }

    /// Source stepping: all sources rise from 0.
    bool source_stepping(std::vector<double>& x) {
        double reached = 0, step = 0.1;  // source_scale of the last solution; its next increase
        newton_.limiting_state = system_.initial_limiting_state();
        newton_.context.source_scale = 0;
        bool found = newton_.solve(x, clamps_);
        for (int tries = 0; found && reached < 1 && tries < 500; ++tries) {
            newton_.context.source_scale = std::min(1.0, reached + step);
            if (advance(x, clamps_, 30))
                reached = newton_.context.source_scale, step *= 2;
            else
                step /= 4, found = step > 1e-7;
        }
        newton_.context.source_scale = 1;
        return found && reached >= 1;
    }

    /// Pseudo-transient: a capacitor from every node to ground and ever longer time steps, until the voltages are constant. A circuit with
    /// positive feedback, such as a Schmitt trigger that switches, moves faster and faster; there the step is limited so that a voltage
    /// changes by about `max_change`. Only the last steps are solved with tight tolerances.
    bool pseudo_transient(std::vector<double>& x) {
        const auto tight = newton_.tolerances;
        auto loose = tight;
        loose.reltol = 1e-2, loose.vntol = 1e-3, loose.abstol = 1e-13;
        newton_.tolerances = loose;
        const bool found = pseudo_transient(x, [&](std::vector<double>& solution) {
            newton_.tolerances = tight;
            const bool ok = newton_.solve(solution, clamps_, 20);
            newton_.tolerances = loose;
            return ok;
        });
        newton_.tolerances = tight;
        return found;
    }
    template <class Solve>
    bool pseudo_transient(std::vector<double>& x, const Solve& solve_tightly) {
        constexpr double max_change = 20e-3, settled_below = 2e-3;  // V
        constexpr int max_iterations = 5;
        double g = 1e-4, failed_g = 0;  // S: capacitance / time step, which is smaller for a longer step; that of the last failed step
        double rate = 0;                // A: largest change of a voltage in the last step, times g
        int limited_steps = 0;          // remaining steps that must be shorter than the failed one
        newton_.limiting_state = system_.initial_limiting_state();
        for (int tries = 0; tries < 600; ++tries) {
            const auto last = x;
            const int before = newton_.iterations;
            if (!advance(x, clamp_all(g, last), max_iterations)) {
                failed_g = g, limited_steps = 20, g *= 3;
                if (g > 1e6) return false;
                continue;
            }
            const double moved = largest_difference(last, x), speedup = rate > 0 ? moved * g / rate : 0;
            rate = moved * g;  // speedup: this rate / that of the step before
            if (moved < 10 * settled_below && g < 1e-13) {
                if (auto solution = x; solve_tightly(solution)) return x = std::move(solution), true;
                if (g < 1e-19) return false;
            }
            const bool quick = newton_.iterations - before <= 3;
            g = speedup > 1.03 ? std::max(rate * speedup / max_change, g) : g / (moved < settled_below ? 10 : quick ? 4 : 2);
            if (limited_steps > 0) --limited_steps, g = std::max(g, 1.5 * failed_g);
        }
        return false;
    }
    /// Pseudo-transient with tight tolerances in every step. A step is shortened only after a failure. Slow but robust.
    bool exact_pseudo_transient(std::vector<double>& x) {
        double g = 1e-4;
        newton_.limiting_state = system_.initial_limiting_state();
        for (int tries = 0; tries < 2000; ++tries) {
            if (advance(x, clamp_all(g, x), 20)) {
                if (g < 1e-19) return newton_.solve(x, clamps_);
                g /= 2;
            } else if ((g *= 8) > 1e6) {
                return false;
            }
        }
        return false;
    }
    /// The largest difference of a node voltage, V.
    double largest_difference(const std::vector<double>& a, const std::vector<double>& b) const {
        double largest = 0;
        for (std::size_t n = 0; n < nodes_; ++n) largest = std::max(largest, std::abs(a[n] - b[n]));
        return largest;
    }

    /// Replaces x by the solution with the nodes of .nodeset clamped, if it is found.
    void apply_nodesets(std::vector<double>& x) {
        const auto& nodesets = system_.circuit().nodesets;
        if (nodesets.empty()) return;
        NodeClamps clamps = clamp_all(0, std::vector<double>(x.size()));
        for (const auto& [node, v] : nodesets)
            clamps.conductance[static_cast<std::size_t>(node) - 1] = 1e3, clamps.voltage[static_cast<std::size_t>(node) - 1] = v;
        auto clamped = x;
        if (newton_.solve(clamped, clamps)) x = clamped;
    }

public:
    OperatingPointSearch(NewtonSolver& newton, std::vector<double> start, NodeClamps clamps)
        : newton_(newton), system_(newton.system), has_guess_(!start.empty()), start_(std::move(start)),
          nodes_(static_cast<std::size_t>(system_.nodes())), clamps_(std::move(clamps)) {
        start_.resize(static_cast<std::size_t>(system_.size()));
        newton_.iterations = 0;
    }

    /// Searches from the start, then again without the guess.
    Result<OperatingPoint> run() {
        if (has_guess_)
            if (auto found = from_start()) return *found;
        if (has_guess_ && !system_.is_linear()) has_guess_ = false, start_.assign(start_.size(), 0.0);  // retry without the guess
        if (!has_guess_) {
            apply_nodesets(start_);
            if (auto found = from_start()) return *found;
        }
        return failure();
    }

private:
    /// Tries all methods from start_.
    std::optional<OperatingPoint> from_start() {
        struct Method {
            std::string_view name;
            bool (OperatingPointSearch::*run)(std::vector<double>&);
        };
        const Method newton{"newton", &OperatingPointSearch::plain_newton}, gmin{"gmin", &OperatingPointSearch::gmin_stepping},
            source{"source", &OperatingPointSearch::source_stepping}, time{"pseudo-transient", &OperatingPointSearch::pseudo_transient},
            exact_time{"pseudo-transient", &OperatingPointSearch::exact_pseudo_transient};
        // If the start is near the solution, the pseudo-transient follows the motion of the circuit; gmin and source stepping ignore it.
        for (const Method& method : has_guess_ ? std::array{newton, time, gmin, source} : std::array{newton, gmin, source, exact_time}) {
            auto x = start_;
            if ((this->*method.run)(x)) return OperatingPoint{std::move(x), method.name, newton_.iterations};
            if (last_.empty()) last_ = std::move(x);
            if (system_.is_linear()) break;
        }
        return {};
    }

    Error failure() {
        if (newton_.is_stopped()) return interrupted_error();
        const auto& c = system_.circuit();
        if (system_.is_linear() && newton_.singular_unknown >= 0)
            return {ErrorCode::bad_input,
                    fmt::format("the equations have no unique solution: the matrix is singular at {}",
                                system_.names()[static_cast<std::size_t>(newton_.singular_unknown)]),
                    SourceLocation{c.file}};
        return {ErrorCode::not_converged,
                fmt::format(
                    "no operating point found: Newton's method, gmin stepping, source stepping and pseudo-transient did not converge ({} "
                    "iterations); {}{}",
                    newton_.iterations, newton_.describe_residual(last_),
                    newton_.singular_unknown >= 0
                        ? fmt::format("; singular at {}", system_.names()[static_cast<std::size_t>(newton_.singular_unknown)])
                        : ""),
                SourceLocation{c.file}};
    }
};

}  // namespace

std::optional<double> smallest_gmin(const Circuit& c) {
    std::optional<double> out;
    for (const auto& e : c.elements)
        if (const double gmin = kind_of(e).gmin; gmin > 0) out = std::min(out.value_or(gmin), gmin);
    return out;
}

Tolerances Tolerances::from_options(const Circuit& c) {
    Tolerances t;
    t.reltol = value_or(c.options, "reltol", t.reltol);
    t.vntol = value_or(c.options, "vntol", t.vntol);
    t.abstol = value_or(c.options, "abstol", t.abstol);
    t.gmin = value_or(c.options, "gmin", smallest_gmin(c).value_or(t.gmin));
    t.itl1 = static_cast<int>(value_or(c.options, "itl1", t.itl1));
    return t;
}

Result<OperatingPoint> find_operating_point(NewtonSolver& newton, std::vector<double> start, NodeClamps clamps) {
    constexpr std::size_t max_joint_changes = 20;  // afterwards, one state is changed at a time, since some may depend on each other
    const System& system = newton.system;
    const auto max_changes = max_joint_changes + 4 * system.devices_with_states().size();
    const Device* changed = nullptr;
    int iterations = 0;
    for (std::size_t changes = 0; changes <= max_changes; ++changes) {
        auto found = OperatingPointSearch(newton, std::move(start), clamps).run();
        if (!found) return found;
        iterations = found->iterations += iterations;
        changed = system.change_states(found->x, changes >= max_joint_changes);
        if (changed == nullptr) return found->states = system.states(), found;
        start = std::move(found->x);
    }
    return Error{ErrorCode::not_converged,
                 fmt::format("no operating point found: {} has no state that agrees with its control: each of the two leads to the other. "
                             "Set the voltage at which a transient begins with .ic, or with uic",
                             changed->name),
                 changed->location};
}

}  // namespace corpuscle::circuit
