#pragma once
// Step size and order control of a transient, and convergence control of its Newton iterations. Independent of circuits: all errors are
// relative to the allowed error.

#include <algorithm>

#include "core/number/elementary.hpp"

namespace corpuscle::circuit {

/// Chooses the length and the order of the next BDF step.
struct StepControl {
    int order = 1;
    int min_order = 1;                 ///< the order is lower only after restart()
    int steps_since_order_change = 0;  ///< accepted steps
    int failures = 0;                  ///< successive rejected steps
    double rejected_length = 0;        ///< length of the last rejected step, s; 0 if its equations were not solved or no step was rejected
    double rejected_error = 0;         ///< its error, relative to the allowed error
    bool starting = true;              ///< every step since restart() has used the highest order that its points allow
    double h = 0;                      ///< s: length of the next step
    double recent_max_step = 0;        ///< s: longest of the recent steps, with exponential decay

    /// Factor of the step length. It is below 1, since a rejected step costs more than several shorter ones.
    static constexpr double safety = 0.65;
    static constexpr double max_growth = 2;       ///< largest ratio of successive step lengths
    static constexpr double curve_tolerance = 2;  ///< allowed interpolation error between two points, relative to the allowed error
    static constexpr int max_curve_points = 5;    ///< maximum number of points of the interpolating polynomial

    /// Factor of the length of a step with this error that gives about the allowed error with a method of this order; at most 10.
    static double growth_factor(double error, int order) {
        return error > 0 ? std::min(safety * num::exp(num::log(error) / -(order + 1)), 10.0) : 10;
    }

    void restart() { order = 1, steps_since_order_change = 0, starting = true, rejected_length = 0; }

    /// True if choose() needs the errors of the next lower and higher order.
    bool is_order_change_due() const { return steps_since_order_change > order || starting; }
    bool can_lower_order() const { return order > min_order; }
    /// `highest`, `points`: see choose().
    bool can_raise_order(int highest, int points) const { return order < highest && points > order + 1; }

    /// Call after an accepted step of this length (s) and error. `points` is the number of points before this step that the formula may
    /// use, `highest` the largest allowed order, and error_of(order) the error that the step would have with another order.
    template <class ErrorOf>
    void choose(double length, double error, int points, int highest, ErrorOf&& error_of) {
        double factor = growth_factor(error, order);
        if (is_order_change_due()) {
            steps_since_order_change = 0;
            // Factors of the step length; 0.9 favours the present order.
            const double lower = can_lower_order() ? 0.9 * growth_factor(error_of(order - 1), order - 1) : 0;
            const double higher = can_raise_order(highest, points) ? 0.9 * growth_factor(error_of(order + 1), order + 1) : 0;
            if (lower > factor && lower > higher)
                --order, factor = lower, starting = false;
            else if (higher > factor)
                ++order, factor = higher;
            else if (starting && order < highest)
                ++order;
        }
        scale_step(length, factor, points);
    }
    /// A step that begins at `from` (s) with length h, or ends at the next breakpoint of the sources or at the next sample of the noise.
    /// Just before these the rest is divided in two.
    struct Step {
        double from, end;
        bool ends_at_breakpoint;  ///< of the sources
        bool is_shortened;        ///< true if it ends at a breakpoint or a sample
        double length() const { return end - from; }
    };
    static Step plan_step(double from, double h, double breakpoint, double sample) {
        const double limit = std::min(breakpoint, sample);
        const bool ends_at_limit = from + 1.01 * h >= limit;
        if (!ends_at_limit && from + 2 * h > limit) h = (limit - from) / 2;
        return {from, ends_at_limit ? limit : from + h, ends_at_limit && breakpoint <= sample, ends_at_limit};
    }
    /// Call after choose() for an accepted step that was planned with the length `planned`. Limits the next step so that its interpolation
    /// error is allowed, unless the step may contain a jump. `error` is the interpolation error of the step, relative to the allowed error;
    /// `points` is the number of points of the interpolating polynomial. A step that only a breakpoint or a sample has shortened does not
    /// shorten the next one.
    void limit_next_step(const Step& step, double planned, double max_step, bool may_jump, double error, int points) {
        if (!may_jump) h = std::min(h, step.length() * std::clamp(growth_factor(error, points - 1), 0.3, max_growth));
        if (step.is_shortened && step.length() < planned) h = std::max(h, std::min(planned, max_step));
    }
    /// Call after an accepted step of this length (s).
    void record_step(double length) {
        recent_max_step = std::max(length, 0.7 * recent_max_step);
        ++steps_since_order_change, failures = 0, rejected_length = 0;
    }
    /// The number of points of the interpolation in the last step. If the step did not determine it (`found` is 0), it is at least 4 where
    /// there are as many.
    int interpolation_points(int found, int count) const { return found > 0 ? found : std::min(std::max(order + 1, 4), count); }
    /// The shortest step, s, of a transient that ends at `stop`.
    static double min_step(double stop) { return 1e-15 * stop; }
    /// Within a step of up to this length (s) the solution may jump. The error of unknowns without charge and of the interpolation then
    /// does not lead to a rejection, and interpolation within the step is linear.
    double jump_step_limit(double reltol, double max_step) const { return std::max(reltol * recent_max_step, 1e-9 * max_step); }
    /// Sets h to this factor of a length, within limits. `points` as in choose().
    void scale_step(double length, double factor, int points) { h = length * std::clamp(factor, 0.3, points < 3 ? 5 : max_growth); }

    /// Call after a rejected step of this length (s). `error` is 0 if the equations were not solved. `previous` is the length (s) of the
    /// last accepted step, 0 if there was none since the integration restarted. Returns true if the integration must restart from the last
    /// point: if the step shrinks to less than a tenth of the previous one, or after more than `max_failures` rejections, unless the last
    /// one reduced the error at least as length^0.7.
    ///
    /// Near a kink the error falls in proportion to the length, for every order. The exponent is therefore measured from the last two
    /// errors, from the second rejection on (only if max_failures > 1).
    bool shorten(double length, double error, double previous, int max_failures = 1) {
        ++failures;
        double exponent = order + 1;
        bool falls = false;
        if (max_failures > 1 && previous > 0 && error > 0 && rejected_length > length && rejected_error > error) {
            exponent = std::clamp(num::log(rejected_error / error) / num::log(rejected_length / length), 0.5, exponent);
            falls = exponent >= 0.7;
        }
        rejected_length = error > 0 ? length : 0, rejected_error = error;
        const double factor = error > 0 ? safety * num::exp(num::log(error) / -exponent) : 0.125;
        h = length * (error > 0 ? std::clamp(factor, previous > 0 ? 0.1 : 1e-3, 0.8) : factor);
        return previous > 0 && ((failures > max_failures && !falls) || h < 0.1 * previous);
    }
};

/// Convergence control of the Newton iterations of one time step.
struct NewtonControl {
    enum class Status { iterating, converged, diverged };
    static constexpr int max_iterations = 12;
    static constexpr double convergence_limit = 0.03;  ///< error that the iteration may leave, relative to the allowed error
    // After a Newton step larger than large_step, the error of the time step is estimated. If the estimate exceeds hopeless_error, the time
    // step is rejected without further iterations. Both are relative to the allowed error.
    static constexpr double large_step = 20, hopeless_error = 2;

    int iterations = 0;    ///< of this time step
    double last_size = 0;  ///< size of the last Newton step, relative to the allowed error; 0: it was limited, or there was none
    /// Estimate of (error after a Newton step) / (size of the step)^2. It is kept from one time step to the next.
    double quadratic_factor = 1;

    void begin() { iterations = 0, last_size = 0; }
    /// True if the error of the time step is needed after an iteration with this status.
    bool needs_error(Status status) const { return status == Status::converged || last_size > large_step; }
    /// True if the iterations continue although the time step has this error.
    static bool must_continue(Status status, double error) { return status == Status::iterating && !(error > hopeless_error); }
    /// Call this if the iteration has not converged although the last Newton step was small.
    Status continue_iterating() const { return iterations < max_iterations ? Status::iterating : Status::diverged; }
    /// Call this after a Newton step of this size for nonlinear equations. is_limited: the step was limited, or a device was evaluated at
    /// limited voltages.
    Status update(double size, bool is_limited) {
        const double last = last_size;
        last_size = is_limited ? 0 : size, ++iterations;
        if (is_limited) return iterations < max_iterations ? Status::iterating : Status::diverged;
        if (last > 0.1) quadratic_factor = std::max(0.7 * quadratic_factor, std::min(1.0, size / (last * last)));
        if (quadratic_factor * size * size <= convergence_limit && (size < 10 || last > 0)) return Status::converged;
        return iterations >= max_iterations || (last > 0 && size > 2 * last && iterations > 3) ? Status::diverged : Status::iterating;
    }
};

}  // namespace corpuscle::circuit
