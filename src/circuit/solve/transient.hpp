#pragma once
// A circuit in time: f(x, t) + dq(x)/dt = 0, in steps as long as accuracy allows.

#include <algorithm>
#include <functional>
#include <optional>

#include "circuit/solve/past.hpp"
#include "circuit/solve/step_equations.hpp"

namespace corpuscle::circuit {

enum class Integration { bdf, trapezoidal };

struct TransientPlan {
    double stop = 0, longest = 0;  ///< s: where it ends; the longest step
    Integration method = Integration::bdf;
    int order = 4;          ///< of BDF, at the most
    double reltol = 1e-5;   ///< of a step's error, against the largest value so far
    double vntol = 1e-6;    ///< V, beside it
    double abstol = 1e-16;  ///< A, of currents
    /// Unknowns whose values between steps are used: the curve through the points must hold them as exactly as a step's end.
    std::vector<int> reported = {};
    bool all_reported = false;  ///< every unknown is, at the steps' ends and between them, and a point follows at once after each corner
    bool steps_only = false;    ///< run() gives the steps' ends alone
};

/// What was done.
struct TransientWork {
    long steps = 0, rejected = 0, lost = 0, iterations = 0;  ///< lost: of the rejected, those where Newton's steps did not arrive
};

/// All that the next step depends on, with the same circuit begun from the same x.
struct TransientState {
    std::vector<Moment> past;  ///< newest first
    int order = 1, since_choice = 0, failures = 0;
    bool starting = true, bent = false;
    double h = 0, bend = 1, calm = 0;
    int calming = 0;
    int count = 1, curve = 0, opening = 0;  ///< points that the rule uses; points of the last curve; how a start goes on
    std::vector<double> scale, rate, memory, turn, fastest;
    std::vector<int> alternations;
    TransientWork work;
};

/// Steps of variable length and order: BDF with the coefficients of the points as they stand, or the trapezoidal rule. The polynomial
/// through the points before predicts; how far charges come to be from it is what the rule of this order leaves over in the equations, and
/// the matrix turns that into the error of each voltage, which decides whether a step counts, how long the next one is, and of what order.
/// The trapezoidal rule rings where something is much faster than its steps: then two steps of BDF calm it.
/// A polynomial through the last points is the curve between them. A step counts only if that holds each reported unknown, too, by what
/// the next higher degree would make of it; of an unknown that jumps no polynomial does, and the jump ends in a step so short that a
/// straight line will do. A node that sources alone hold goes as they do.
/// Right after the beginning, at every corner of a source, and where steps must shrink tenfold, all begins again with order 1.
class Transient {
public:
    using Each = std::function<bool(double t, std::span<const double> x)>;

private:
    System& system_;
    Newton& newton_;
    TransientPlan plan_;
    StepEquations equations_;
    Past past_;
    StepControl pace_;
    double leading_ = 0;
    bool ordered_ = false;  // the matrix's elimination, once and for all
    bool bent_ = false;     // the last point is a source's corner, or a jump's end: from there it starts over
    bool jump_ = false;     // the step at work is so short that it may hold a jump
    enum class Opening { none, first, at_once } opening_ = Opening::none;     // after a corner: a point at once, a first step
    int curve_ = 0;                                                           // points of the curve in the last step; 0: as the rule has it
    double others_ = 0;                                                       // the error of unknowns without charge in the last step
    double volts_ = 0, largest_charge_ = 0, fastest_charge_ = 0;              // V, C, A: what rounding is measured by
    bool arrived_ = false, rounding_measured_ = false;                        // of the step at work
    std::vector<double> capacity_, rounding_;                                 // F, of each node; of each unknown, see noise()
    std::vector<double> scale_, allowed_, may_err_, history_, rate_, error_;  // may_err_: of what is reported
    std::vector<char> charged_;
    std::vector<int> curves_;  // unknowns that are reported and that sources alone do not hold
    struct Held {              // a node's voltage is that of a source, upon that of another node
        int unknown, base;
        const Device* source;
        double sign;
    };
    std::vector<Held> held_;
    std::vector<int> held_at_;
    std::vector<double> turn_, fastest_;  // of the trapezoidal rule: the last change of rate, the fastest rate
    std::vector<int> alternations_;       // how often in a row it went to and fro
    int calming_ = 0;                     // steps still to be taken by BDF

    TransientWork work_;

    bool trapezoid() const { return plan_.method == Integration::trapezoidal && calming_ == 0; }
    void watch();
    int points_between() const { return curve_ > 0 ? curve_ : std::min(std::max(pace_.order + 1, 4), past_.count()); }
    void find_held();
    double held(const Held&, double t) const;
    double noise(int unknown) const;
    void measure_rounding(double& error, double& off);
    double bend();
    bool open(double t0, double corner, double& t);
    void start_over(bool forget, bool exact = false);
    Result<void> settle();
    Error too_short(double h);
    bool attempt(double t, double& error);
    double error_of(int order);
    double worst_error();
    void allow();
    void choose(double h, double error);
    Result<void> shorten(double h, double error);
    void take();
    bool tell(const Each& each);

public:
    Transient(System& system, Newton& newton, const TransientPlan& plan)
        : system_(system), newton_(newton), plan_(plan), equations_(system, newton) {}

    /// See begin(); calls each(t, x) from t = 0 on until it returns false or the end is reached: at every step, and between them where a
    /// straight line would be off by more than a few times the allowed error. An error says when no step was short enough, and where.
    Result<void> run(std::vector<double> x, bool settled, const Each& each, std::span<const double> charge = {});
    const TransientWork& work() const { return work_; }
    const TransientPlan& plan() const { return plan_; }
    std::span<const int> curves() const { return curves_; }  ///< unknowns whose curves between points are held to what they may err
    bool charged(std::size_t unknown) const { return charged_[unknown] != 0; }  ///< whether it holds a charge, so that its error counts
    /// Once it has begun; null: there is no list of its elimination.
    const Elimination* elimination() const { return equations_.elimination(); }

    /// At t = 0, from x; not settled: only charges are as they should be, and what no charge holds follows from them. `charge` is added to
    /// the charges at x (of ic= on elements; empty: nothing). The matrix's order of
    /// elimination is that of the first x handed in, so that steps after restore() are those that would have come.
    Result<void> begin(std::vector<double> x, bool settled = true, std::span<const double> charge = {});
    /// Of a node that sources alone hold, some of which go by time: its voltage; nothing of any other unknown.
    std::optional<double> given(double t, int unknown) const;
    /// One step, not beyond `until`. False: it would go beyond, or its length depends on what comes there.
    Result<bool> step(double until);
    double time() const { return past_[0].t; }
    std::span<const double> x() const { return past_[0].x; }
    /// An unknown between the last two points (-1: ground), as the polynomial of the last steps has it.
    double between(double t, int unknown) const;
    void between(double t, std::span<double> x) const;
    /// The first time since the point before the last at which plus - minus (unknowns; -1: ground) crosses a level: upwards, or downwards.
    std::optional<double> crossing(int plus, int minus, double level, bool upwards) const;

    TransientState save() const;
    /// After begin(), from the x that the one who saved began from. Steps are the same to the last bit if the first x that each was ever
    /// handed is the same, too.
    void restore(const TransientState&);
};

}  // namespace corpuscle::circuit
