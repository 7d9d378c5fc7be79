#pragma once
// The equations of one step in time, f(x, t) + a q(x) + history = 0, and Newton's way to their answer.

#include "circuit/solve/operating_point.hpp"
#include "circuit/solve/side_by_side.hpp"
#include "circuit/solve/step_control.hpp"

namespace corpuscle::circuit {

/// Linear devices are summed once and for all, sources once a step; of the others only what the matrix needs is put together, so that an
/// iteration costs little more than its transistors and one elimination. The charges of the answer follow along their slopes: what a step
/// leaves over the next one finds, and none is lost.
/// How far a formula may be from its straight line where Newton's steps end.
struct FormulaTolerance {
    double reltol = 0, vntol = 0, abstol = 0;
    bool holds(bool volts, double off, double size) const {
        constexpr double times = 10;
        return std::abs(off) <= times * (reltol * size + (volts ? vntol : abstol));
    }
};

class StepEquations {
    const System& system_;
    Newton& newton_;
    struct Linear {
        std::size_t place;
        int row, column;
        double g, c;
    };
    std::vector<Linear> linear_;
    std::vector<double> still_;         // what linear devices leave at x = 0 that does not change with time
    std::vector<std::size_t> varying_;  // sources on their course
    struct Own {                        // of a device that is not linear and stands alone
        std::size_t device, terminals;
        std::vector<int> unknowns;
        std::vector<double> v, looked, stamp;
        bool limited = false;
    };
    std::vector<Own> own_;
    SideBySide side_by_side_;
    Solver<double> solver_;  // its own: the list of a transient's matrices is not that of an operating point's
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

    /// For a step that ends at t, with dq/dt = a q + history.
    void prepare(double t, double a, std::span<const double> history);
    /// Whether a step is over only when formulas give, at its end, what their straight lines gave: where one jumps these are wrong however
    /// short Newton's last step was.
    void check_formulas(bool on, const FormulaTolerance& t) { checks_formulas_ = on, formulas_ = t; }
    using Way = NewtonControl::Way;
    /// One of Newton's steps from x. Arrived: no unknown with allowed[n] > 0 is further from the answer than a small part of that.
    Way iterate(std::vector<double>& x, std::span<const double> allowed);
    /// The largest part of the last step, in allowed units.
    double step_size() const { return newton_control_.before; }
    /// Of the answer.
    void charges(std::span<double> q);
    /// e with (G + a C) e = r, at the answer's slopes, in place: what a disturbance of the equations does to the unknowns.
    void answer_to(std::span<double> r) const { solver_.solve(r); }
    /// f(x, t), for a = 0 and no history; q(x).
    void at(double t, std::span<const double> x, std::span<double> f, std::span<double> q);
    /// The matrix's order of elimination, for all that follow, is taken from the one at x with dq/dt = a q.
    void settle(std::span<const double> x, double a);
    double bend() const { return newton_control_.bend; }
    void set_bend(double bend) { newton_control_.bend = bend; }
    /// The list of its elimination, once it is settled; null: there is none.
    const Elimination* elimination() const { return solver_.list(); }
};

}  // namespace corpuscle::circuit
