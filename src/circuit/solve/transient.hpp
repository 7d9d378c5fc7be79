#pragma once
// A circuit in time: f(x, t) + dq(x)/dt = 0, in steps as long as accuracy allows.

#include <functional>

#include "circuit/solve/operating_point.hpp"

namespace corpuscle::circuit {

enum class Integration { bdf2, trapezoidal };

struct TransientPlan {
    double stop = 0, longest = 0;  ///< s: where it ends; the longest step
    Integration method = Integration::bdf2;
    double reltol = 1e-4;  ///< of a step's error, against the largest voltage so far
    double vntol = 1e-5;   ///< V, beside it
};

/// What was done.
struct TransientWork {
    long steps = 0, rejected = 0, iterations = 0;
};

/// Variable steps of second order (BDF2 or the trapezoidal rule; backward Euler right after a corner), each compared with the parabola
/// through the points before: their distance tells the step's error (Milne's device), node by node, wherever charge is.
class Transient {
    System& system_;
    Newton& newton_;
    TransientPlan plan_;
    struct Point {
        double t;
        std::vector<double> x, q, dq;
    };
    std::vector<Point> past_;  // newest first, since the last corner
    std::vector<double> scale_, predicted_, history_;
    std::vector<char> charged_;
    TransientWork work_;
    bool trapezoid_ = false;  // the step at work

    void start_over(Point);
    bool solve(double t, std::vector<double>& x);
    double leading(double h) const;
    void predict(double t);
    double error_of(double t, const std::vector<double>& x) const;

public:
    Transient(System& system, Newton& newton, const TransientPlan& plan) : system_(system), newton_(newton), plan_(plan) {}

    /// From x at t = 0 on; calls each(t, x) with every point, x at 0 first, until it returns false or the end is reached. An error says
    /// when no step was short enough, and where.
    Result<void> run(std::vector<double> x, const std::function<bool(double, std::span<const double>)>& each);
    const TransientWork& work() const { return work_; }
};

}  // namespace corpuscle::circuit
