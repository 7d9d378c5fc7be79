#pragma once
// The equations of one time step, f(x, t) + a q(x) + history = 0, and their solution by Newton's method. The integration formula gives a
// and history so that dq/dt = a q(x) + history at the end of the step.

#include "circuit/solve/operating_point.hpp"
#include "circuit/solve/step_control.hpp"

namespace corpuscle::circuit {

/// All device groups of a system. Index lists are made once: the unknown of each terminal, and the derivatives that add up to each matrix
/// entry. Vectors of unknowns have one more element at the end, for ground.
class BatchedDevices {
    struct GroupBuffer {
        const DeviceGroup& group;
        std::size_t offset;  // of the group's values in numbers(): v, f, q [terminals][stride]; df, dq [terminals^2][stride]
    };
    struct alignas(64) CacheLine {
        double values[8];
    };
    /// Index lists that add values to targets, grouped by the number of terms of each target.
    struct ScatterAdd {
        struct Run {  // `count` successive targets, to each of which `terms` values are added
            int terms, count;
        };
        std::vector<Run> runs;
        std::vector<int> to;    // index of each target
        std::vector<int> from;  // indices of the values, target by target
        void add(const double* numbers, double* out) const;
    };
    std::vector<GroupBuffer> buffers_;
    std::vector<CacheLine> lines_;  // storage of numbers()
    std::vector<int> terminals_;    // unknown of each element of v, one buffer after another
    ScatterAdd slopes_, currents_, charges_;

    double* numbers() { return lines_.empty() ? nullptr : lines_[0].values; }
    static ScatterAdd make_scatter(std::vector<std::pair<int, int>> to_from);

public:
    explicit BatchedDevices(const System&);
    BatchedDevices(const BatchedDevices&) = delete;

    /// Evaluates the devices at x; adds f + rate q to the residual r, and df + rate dq to the Jacobian J. rate: 1/s.
    void evaluate(const EvalContext&, double rate, const std::vector<double>& x, std::vector<double>& J, std::vector<double>& r);
    /// Adds the charges at x + step, extrapolated linearly from the last evaluation at x, to q. Call at most once after each evaluate(),
    /// since it overwrites the evaluation.
    void add_charges(const std::vector<double>& step, std::vector<double>& q);
};

/// The largest difference allowed between an expression and its linearization when a Newton iteration ends.
struct ExpressionTolerance {
    double reltol = 0, vntol = 0, abstol = 0;
    /// Compares the value f of an equation with its linearization. The equation of a branch current is a sum of voltages (is_voltage),
    /// that of a node a sum of currents. v: values of the device's unknowns.
    bool accepts(bool is_voltage, double f, double linear, std::span<const double> v) const {
        constexpr double factor = 10;
        const double scale =
            is_voltage ? std::abs(v[0] - v[1]) : std::max(std::abs(f), std::abs(linear));  // of the values compared, V or A
        return std::abs(f - linear) <= factor * (reltol * scale + (is_voltage ? vntol : abstol));
    }
};

/// The derivatives of linear devices are summed once, in the constructor, and the values of sources once per time step. Only the nonlinear
/// devices are evaluated in each iteration, directly into the Jacobian and the residual. So an iteration costs little more than evaluating
/// the transistors and one elimination. The charges at the end of the step are extrapolated linearly from the last evaluation. The charge
/// residual of a step enters the next one, so charge is conserved.
class StepEquations {
    const System& system_;
    NewtonSolver& newton_;
    struct LinearEntries {  // the matrix entries to which linear devices contribute
        std::vector<int> entry, row, column;
        std::vector<double> g, c;  // S and F: sums of their df and dq
    };
    LinearEntries linear_, linear_charges_;    // all, and those with c
    std::vector<double> constant_currents_;    // f of the time-independent linear devices at x = 0
    std::vector<std::size_t> time_dependent_;  // indices of the time-dependent sources
    struct ScalarDevice {                      // a nonlinear device that is not in a group
        std::size_t device, terminals;         // its index; number of its unknowns
        std::vector<int> unknowns;             // ground is the index after the last unknown
        std::vector<double> v, linearized_at;  // its unknowns at the last x, and after limiting
        StampBuffer buffer;
        Stamp stamp;           // in the buffer; f and q are extrapolated to v
        bool limited = false;  // linearized_at differs from v
    };
    std::vector<ScalarDevice> scalar_devices_;
    BatchedDevices batched_devices_;
    LinearSolver<double> solver_;  // not the one of the operating point, whose pivot order differs
    // x_ is the x of the last evaluation, step_ the Newton step from it. base_ is the residual at x = 0 without the nonlinear devices, J_0_
    // the Jacobian of the linear devices. The last element of each vector except scratch_ is for ground.
    std::vector<double> x_, base_, J_0_, J_, r_, step_, scratch_;
    StampBuffer stamp_;
    std::vector<char> is_voltage_;
    NewtonControl newton_control_;
    double a_ = 0;                     // 1/s: dq/dt = a q + history
    bool limited_ = false;             // some device was evaluated at limited voltages
    bool checks_expressions_ = false;  // see check_expressions()
    ExpressionTolerance expression_tolerance_;
    bool expressions_match();

    void linearize(std::span<const double> x);
    void add_linear_charges(std::span<const double> x);
    void linearize_device(ScalarDevice&);
    bool solve_for_step();
    double relative_residual();
    double largest_step(std::span<const double> allowed, bool& clamped);

public:
    long iterations = 0;  ///< of all steps; set to 0 by the caller

    StepEquations(const System&, NewtonSolver&);

    /// Prepares a step that ends at t (s), with dq/dt = a q + history.
    void prepare(double t, double a, std::span<const double> history);
    /// If `enabled`, the iterations converge only when each expression with jumps matches its linearization at the solution. At a jump the
    /// linearization is wrong even if the last Newton step was short.
    void check_expressions(bool enabled, const ExpressionTolerance& tolerance) {
        checks_expressions_ = enabled, expression_tolerance_ = tolerance;
    }
    using Status = NewtonControl::Status;
    /// Takes one Newton step from x. The status is `converged` if the remaining error of every unknown with allowed[n] > 0 is a small part
    /// of allowed[n] (V or A).
    Status iterate(std::vector<double>& x, std::span<const double> allowed);
    NewtonControl& newton_control() { return newton_control_; }
    /// The charges at the result of iterate(). Call at most once after iterate().
    void read_charges(std::span<double> q);
    /// Solves (G + a C) e = r in place, with the last matrix: the effect e of a perturbation r of the equations on the unknowns.
    void solve_perturbation(std::span<double> r) const { solver_.solve(r); }
    /// The diagonal element of the last matrix G + a C in row n.
    double diagonal(std::size_t n) const { return J_[system_.pattern().entry_index(static_cast<int>(n), static_cast<int>(n))]; }
    /// True if charge_change() knows all devices. Transistors that are evaluated together do not keep their capacitances.
    bool has_all_capacitances() const { return system_.groups().empty(); }
    /// Computes C dx with the capacitances of the last evaluation: the change of the charges with the unknowns.
    void charge_change(std::span<const double> dx, std::span<double> dq);
    /// Adds the rounding error of the terms of each equation at x, A or V, to `out`.
    void add_rounding(std::span<const double> x, std::span<double> out) const;
    /// Evaluates f(x, t) and q(x).
    void evaluate_static(double t, std::span<const double> x, std::span<double> f, std::span<double> q);
    /// Fixes the pivot order of all later matrices to that of the matrix at x with dq/dt = a q.
    void fix_pivot_order(std::span<const double> x, double a);
    /// The elimination list after fix_pivot_order(); null: there is none.
    const Elimination* elimination() const { return solver_.elimination(); }
};

}  // namespace corpuscle::circuit
