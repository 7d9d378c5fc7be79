#pragma once
// The equations of one time step, f(x, t) + a q(x) + history = 0, and their solution by Newton's method.

#include "circuit/solve/operating_point.hpp"
#include "circuit/solve/side_by_side.hpp"
#include "circuit/solve/step_control.hpp"

namespace corpuscle::circuit {

/// The largest difference allowed between an expression and its linearization when a Newton iteration ends.
struct FormulaTolerance {
    double reltol = 0, vntol = 0, abstol = 0;
    bool holds(bool is_voltage, double difference, double scale) const {
        constexpr double factor = 10;
        return std::abs(difference) <= factor * (reltol * scale + (is_voltage ? vntol : abstol));
    }
};

/// Linear devices are summed once, sources once per time step, and other devices only into the Jacobian and the residual. So an iteration
/// costs little more than its transistors and one elimination. The final charges are extrapolated linearly from the last evaluation. The
/// charge residual of a step enters the next one, so charge is conserved.
class StepEquations {
    const System& system_;
    Newton& newton_;
    struct Linear {
        std::size_t place;
        int row, column;
        double g, c;
    };
    std::vector<Linear> linear_;
    std::vector<double> still_;         // currents of time-independent linear devices at x = 0
    std::vector<std::size_t> varying_;  // time-dependent sources
    struct Own {                        // a nonlinear device that is not in a group
        std::size_t device, terminals;
        std::vector<int> unknowns;
        std::vector<double> v, looked, stamp;
        bool limited = false;
    };
    std::vector<Own> own_;
    SideBySide side_by_side_;
    Solver<double> solver_;  // not the one of the operating point, whose pivot order differs
    std::vector<double> x_, base_, J_0_, J_, r_, step_, scratch_;
    std::vector<char> voltage_;
    NewtonControl newton_control_;
    double a_ = 0;
    bool limited_ = false, checks_formulas_ = false;
    FormulaTolerance formulas_;
    bool formulas_hold();

    void look(std::span<const double> x);
    void look_at_own(Own&);
    bool solve_for_step();
    double left_over();
    double largest_step(std::span<const double> allowed, bool& clamped);

public:
    long iterations = 0;

    StepEquations(const System&, Newton&);

    /// Prepares a step that ends at t (s), with dq/dt = a q + history.
    void prepare(double t, double a, std::span<const double> history);
    /// If on, an iteration converges only when each expression with jumps matches its linearization at the solution. At a jump the
    /// linearization is wrong even if the last Newton step was short.
    void check_formulas(bool on, const FormulaTolerance& t) { checks_formulas_ = on, formulas_ = t; }
    using Way = NewtonControl::Way;
    /// One Newton step from x. converged: the error of every unknown with allowed[n] > 0 is a small part of allowed[n].
    Way iterate(std::vector<double>& x, std::span<const double> allowed);
    /// The largest component of the last Newton step, relative to the allowed error.
    double step_size() const { return newton_control_.before; }
    /// The charges of the solution.
    void charges(std::span<double> q);
    /// Solves (G + a C) e = r in place, with the derivatives at the solution: the effect of a perturbation of the equations on the
    /// unknowns.
    void answer_to(std::span<double> r) const { solver_.solve(r); }
    /// Evaluates f(x, t) and q(x) without history and with a = 0.
    void at(double t, std::span<const double> x, std::span<double> f, std::span<double> q);
    /// Fixes the pivot order of all later matrices to that of the matrix at x with dq/dt = a q.
    void settle(std::span<const double> x, double a);
    double bend() const { return newton_control_.bend; }
    void set_bend(double bend) { newton_control_.bend = bend; }
    /// The elimination list after fix_pivot_order(); null: there is none.
    const Elimination* elimination() const { return solver_.list(); }
};

}  // namespace corpuscle::circuit
