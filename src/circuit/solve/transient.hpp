#pragma once
// Transient analysis: integrates f(x, t) + dq(x)/dt = 0 with steps as long as the tolerances allow.

#include "circuit/solve/history.hpp"
#include "circuit/solve/order_limit.hpp"
#include "circuit/solve/state_archive.hpp"
#include "circuit/solve/state_change_search.hpp"
#include "circuit/solve/step_equations.hpp"
#include "circuit/solve/transient_noise.hpp"

namespace corpuscle::circuit {

enum class Integration { bdf, trapezoidal };

/// The parameters of a transient.
struct TransientPlan {
    double stop = 0, max_step = 0;  ///< s: end time; longest step
    Integration method = Integration::bdf;
    int max_order = 4;      ///< maximum order of BDF
    double reltol = 1e-5;   ///< allowed error of an unknown in a step, relative to its largest magnitude so far
    double vntol = 1e-6;    ///< V, added to the allowed error of voltages
    double abstol = 1e-16;  ///< A, added to the allowed error of currents
    /// Unknowns whose values between steps are used. Interpolation must be as accurate as the values at the steps' ends.
    std::vector<int> reported = {};
    bool all_reported = false;  ///< true in .tran, false for afferents: all unknowns are reported, with a point right after each breakpoint
    bool steps_only = false;    ///< true: run() calls back only at the steps' ends
    NoisePlan noise = {};       ///< of the devices
};

/// Counters of a transient.
struct TransientStats {
    long steps = 0, rejected = 0;  ///< accepted and rejected steps
    long diverged = 0;             ///< rejected steps whose Newton iterations diverged
    long iterations = 0;           ///< Newton iterations
};

/// Integration with variable step and order: variable-coefficient BDF or the trapezoidal rule. The polynomial through the earlier points is
/// the predictor. The difference between the charges and their prediction gives the truncation error of the formula in the equations. The
/// Jacobian converts it to the error of each unknown, which decides acceptance and the length and order of the next step.
/// The trapezoidal rule rings if the circuit is much faster than the step; two BDF steps then damp the ringing.
/// Between points the solution is interpolated by a polynomial through the last points. A step is accepted only if the interpolation error
/// of each reported unknown, estimated with the next higher degree, is allowed as well. A jump has no such polynomial. The steps shrink
/// until the jump is in a step so short that the values between its ends do not matter, and interpolation is linear. A node voltage that is
/// defined by sources only is computed exactly from their waveforms. Integration restarts with order 1 at the beginning, at every
/// breakpoint of a source, where a device changes its state, and when the step must shrink tenfold.
///
/// With noise the equations are f(x, t) + d(q(x) + w(t))/dt = 0, where w is the charge that the noise currents have carried. The formulas
/// are applied to q + w (Winkler, J. Comput. Appl. Math. 157, 2003): its derivative -f(x) is smoother than the noise current, so its
/// prediction gives the error of the formula alone, not the noise. No step is longer than the interval of the noise, and steps end at its
/// samples. Interpolation is linear. The order is 2: order 1 damps noise near fmax, and higher orders need a smoother charge.
class Transient {
public:
    using PointCallback = std::function<bool(double t, std::span<const double> x)>;

private:
    System& system_;
    NewtonSolver& newton_;
    TransientPlan plan_;
    StepEquations equations_;
    History history_points_;
    StepControl control_;
    OrderLimit order_limit_;
    StateChangeSearch state_change_;
    std::optional<TransientNoise> noise_;
    std::vector<NodeNoise> node_noise_;                  // by unknown
    std::vector<double> own_capacitance_;                // F, by unknown: the diagonal of C at the start
    std::vector<double> last_noise_charge_;              // C, by equation, of the last step
    std::vector<double> noise_charge_, shifted_charge_;  // C, by equation, in the step that is tried; subtracted from the earlier points
    double last_change_ = 0;                             // s: time of the last change of a state
    int shortest_steps_ = 0;                             // number of successive steps of the shortest length
    int changes_at_once_ = 0;                            // number of changes of states since the time last advanced
    double leading_ = 0;                                 // 1/s: dq/dt = leading_ q + history_ in the current step
    bool pivot_order_fixed_ = false;                     // true after the first begin(), which fixes the pivot order of the matrix
    bool restart_pending_ = false;          // the last point is a breakpoint of a source or the end of a jump: integration restarts there
    bool may_jump_ = false;                 // the current step is so short that it may contain a jump
    bool accepts_breakpoint_step_ = false;  // the point just after a breakpoint is accepted with any error
    enum class StartPhase {
        none,
        first_step,  // the next step is the first normal one after a breakpoint, which is short
        breakpoint   // the next step ends immediately after a breakpoint
    } start_phase_ = StartPhase::none;
    int curve_points_ = 0;             // points of the interpolation in the last step; 0: not determined, see interpolation_points()
    double uncharged_error_ = 0;       // largest error of an unknown without charge in the last step, relative to the allowed error
    double voltage_scale_ = 0;         // V: scale of the rounding error of charges
    bool converged_ = false;           // the current step
    std::vector<double> capacitance_;  // F, by equation: sum of the magnitudes in its row of C
    // By unknown: its rounding error in the present step, A or V, and the same over leading_ in the step that was measured last.
    std::vector<double> rounding_, charge_rounding_;
    // By unknown. scale_ is the largest magnitude so far. The error at the end of a step is compared with allowed_error_ (0: not
    // controlled), that of reported values with tolerance_. rate_ is dq/dt at the newest point; error_ is a buffer.
    std::vector<double> scale_, allowed_error_, tolerance_, history_, rate_, error_, charge_error_;
    std::vector<char> has_charge_;
    std::vector<int> interpolated_unknowns_;  // reported unknowns that are interpolated
    struct SourceNode {  // a node whose voltage is that of the unknown `base` (-1: ground) plus `sign` times the source's voltage
        int unknown, base;
        const Device* source;
        double sign;
    };
    std::vector<SourceNode> source_nodes_;
    std::vector<int> source_node_index_;          // by unknown, index in source_nodes_; -1: none
    std::vector<double> rate_change_, max_rate_;  // for detect_ringing(): change of dq/dt in the last step; largest dq/dt so far
    std::vector<int> alternations_;               // number of successive sign changes of rate_change_
    int damping_steps_ = 0;                       // remaining BDF steps that damp ringing

    TransientStats stats_;

    bool is_shortest(double h) const { return h <= 1.5 * StepControl::min_step(plan_.stop); }  // h: length of a step, s
    bool uses_trapezoidal() const { return plan_.method == Integration::trapezoidal && damping_steps_ == 0; }
    void detect_ringing();
    int interpolation_points() const { return control_.interpolation_points(curve_points_, history_points_.count()); }
    void find_source_nodes();
    double source_node_voltage(const SourceNode&, double t) const;
    void measure_rounding();
    void measure_rounding(double& error, double& curve_error);
    bool is_rounding_visible();
    double interpolation_error();
    bool must_accept_breakpoint_step();
    bool take_breakpoint_step(double t0, double next_breakpoint);
    void restart(bool forget, bool exact = false);
    void shift_charges(double t);
    void undo_charge_shift();
    void measure_noise();
    std::optional<std::vector<double>> solve_with_charges_kept(double h);
    bool are_close(std::span<const double> a, std::span<const double> b) const;
    Result<void> make_consistent();
    Result<void> change_states();
    bool must_locate_change();
    std::vector<double> state_tolerances() const;
    std::string describe_error();
    Error step_too_short(double h, double a, std::string reason);
    bool attempt(double t, double& error);
    double error_of(int order);
    double worst_error();
    double worst_error_of_charges();
    void update_tolerances();
    void choose_step(double h, double error);
    Result<void> reject_step(double h, double error);
    void accept_step();
    bool emit_points(const PointCallback& each);

public:
    Transient(System& system, NewtonSolver& newton, const TransientPlan& plan)
        : system_(system), newton_(newton), plan_(plan), equations_(system, newton), state_change_(system) {
        if (!plan.noise.is_on()) return;
        noise_.emplace(system, plan.noise);
        plan_.max_step = std::min(plan.max_step, plan.noise.interval());
        plan_.max_order = control_.min_order = std::min(plan.max_order, TransientNoise::best_order);
    }

    /// Calls begin() with these arguments and simulates until `each` returns false or the end time is reached. Calls each(t, x) at t = 0,
    /// at the end of every step, and at points within a step if linear interpolation across it would have an error of more than twice the
    /// allowed error. If a step becomes too short, the error names the time and the unknown.
    Result<void> run(std::vector<double> x, bool settled, const PointCallback& each, std::span<const double> charge = {});
    const TransientStats& stats() const { return stats_; }
    const TransientPlan& plan() const { return plan_; }
    /// The unknowns whose interpolation error is controlled.
    std::span<const int> interpolated_unknowns() const { return interpolated_unknowns_; }
    /// True if the unknown has a charge, so that its error is controlled.
    bool has_charge(std::size_t unknown) const { return has_charge_[unknown] != 0; }
    /// The noise, after begin(); null: there is none.
    TransientNoise* noise() { return noise_ ? &*noise_ : nullptr; }
    void set_noise_stream(std::uint64_t stream) { plan_.noise.stream = stream; }  ///< from the next begin() on
    /// The elimination list, after begin(); null: there is none.
    const Elimination* elimination() const { return equations_.elimination(); }

    /// Starts at t = 0 from x. settled: x solves the equations at t = 0. Otherwise only the charges at x are used, and the unknowns without
    /// charge are computed from them. `charge`, by equation, is added to the charges at x (from ic= of elements; empty: nothing). The pivot
    /// order of the matrix is that at the x of the first call, so that the steps after restore() are identical to those without a save.
    Result<void> begin(std::vector<double> x, bool settled = true, std::span<const double> charge = {});
    /// The voltage at t of a node that is defined by voltage sources only, at least one of them time-dependent. Nothing for any other
    /// unknown.
    std::optional<double> source_voltage(double t, int unknown) const;
    /// Takes one step that ends at or before `until` (s). Returns false, without a step, if the step would end later, or if its length
    /// depends on source values after `until`.
    Result<bool> step(double until);
    double time() const { return history_points_[0].t; }  ///< s: end of the last step
    std::span<const double> x() const { return history_points_[0].x; }
    /// Interpolates an unknown (-1: ground) at t, between the last two points.
    double interpolate(double t, int unknown) const;
    /// Interpolates all unknowns.
    void interpolate(double t, std::span<double> x) const;
    /// The first time found in the last step at which the difference of the unknowns `plus` and `minus` (-1: ground) crosses a level;
    /// downwards if not `upwards`.
    std::optional<double> crossing(int plus, int minus, double level, bool upwards) const;

    /// Writes or reads the complete state. The next steps depend only on this, the circuit and the first x ever passed to begin(). Before
    /// reading, call begin() with the same x as the saved transient.
    void archive(StateArchive&);
    void shift_origin(double t);  ///< moves the origin of time to t, s
    const History& history() const { return history_points_; }
    const StepControl& control() const { return control_; }
    // By unknown: the largest magnitude so far, and dq/dt at the newest point.
    const std::vector<double>& scale() const { return scale_; }
    const std::vector<double>& rate() const { return rate_; }
};

}  // namespace corpuscle::circuit
