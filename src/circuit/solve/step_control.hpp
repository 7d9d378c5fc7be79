#pragma once
// Step size and order control of a transient, and convergence control of its Newton iterations. Pure numbers, independent of circuits.

#include <algorithm>
#include <cmath>

#include "signal/elementary.hpp"

namespace corpuscle::circuit {

/// Chooses the length and the order of the next BDF step.
struct StepControl {
    int order = 1, since_choice = 0, failures = 0;
    bool starting = true;  ///< since the start, every step has used the highest order that its points allow
    double h = 0;          ///< s
    double calm = 0;       ///< s: longest of the recent steps, with exponential decay

    static constexpr double safety = 0.65;  ///< below 1, since a rejected step costs more than several shorter ones
    static constexpr double longer = 2;     ///< largest ratio of successive step lengths
    static constexpr double curved = 2;     ///< allowed interpolation error between two points, relative to the allowed error
    static constexpr int curve_points = 5;  ///< maximum number of points of the interpolating polynomial

    /// Factor of the step length for which a method of this order would have exactly the allowed error.
    static double growth(double error, int order) {
        return error > 0 ? std::min(safety * num::exp(num::log(error) / -(order + 1)), 10.0) : 10;
    }

    void start_over() { order = 1, since_choice = 0, starting = true; }

    /// True if choose() needs the errors of the next lower and higher order.
    bool looks_around() const { return since_choice > order || starting; }
    bool can_fall() const { return order > 1; }
    bool can_rise(int highest, int points) const { return order < highest && points > order + 1; }

    /// After an accepted step of length `taken` with this error. points: number of earlier points; highest: largest allowed order;
    /// error_of(order): error of the step for another order.
    template <class ErrorOf>
    void choose(double taken, double error, int points, int highest, ErrorOf&& error_of) {
        double factor = growth(error, order);
        if (looks_around()) {
            since_choice = 0;
            const double lower = can_fall() ? 0.9 * growth(error_of(order - 1), order - 1) : 0;
            const double higher = can_rise(highest, points) ? 0.9 * growth(error_of(order + 1), order + 1) : 0;
            if (lower > factor && lower > higher)
                --order, factor = lower, starting = false;
            else if (higher > factor)
                ++order, factor = higher;
            else if (starting && order < highest)
                ++order;
        }
        stretch(taken, factor, points);
    }
    /// After choose(): limits the step so that the interpolation error stays allowed. error: that of the last step, relative to the allowed
    /// error; points: of the interpolating polynomial.
    void hold(double taken, double error, int points) { h = std::min(h, taken * std::clamp(growth(error, points - 1), 0.3, longer)); }
    void took(double step) { calm = std::max(step, 0.7 * calm); }
    /// Steps up to this length may contain a jump. Unknowns without charge are then checked at the ends only, and interpolation is linear.
    double jump(double reltol, double max_step) const { return std::max(reltol * calm, 1e-9 * max_step); }
    void stretch(double taken, double factor, int points) { h = taken * std::clamp(factor, 0.3, points < 3 ? 5 : longer); }

    /// After a rejected step of length `taken`. error: relative to the allowed error; 0: the equations were not solved. last: length of the
    /// step before, 0 if there was none since the start. Returns true if the integration must restart from the last point, which happens
    /// after more than `max_failures` failures or a strong reduction.
    bool shorten(double taken, double error, double last, int max_failures = 1) {
        ++failures;
        h = taken * (error > 0 ? std::clamp(growth(error, order), last > 0 ? 0.1 : 1e-3, 0.8) : 0.125);
        return last > 0 && (failures > max_failures || h < 0.1 * last);
    }
};

/// Convergence control of the Newton iterations of one time step.
struct NewtonControl {
    enum class Way { on, arrived, lost };
    static constexpr int most_iterations = 12;
    static constexpr double near_enough = 0.03;  ///< error that the iteration may leave, relative to the allowed error

    int tries = 0;
    double before = 0;  ///< size of the last Newton step, relative to the allowed error; 0: it was limited
    double bend = 1;    ///< constant of the quadratic convergence: error after a step / (size of the step)^2

    void begin() { tries = 0, before = 0; }
    /// The iteration has not converged although the last Newton step was small.
    Way not_yet() const { return tries < most_iterations ? Way::on : Way::lost; }
    /// After a Newton step of this size for nonlinear equations. is_limited: the step was limited, or a device was evaluated elsewhere.
    Way after(double size, bool is_limited) {
        const double last = before;
        before = is_limited ? 0 : size, ++tries;
        if (is_limited) return tries < most_iterations ? Way::on : Way::lost;
        if (last > 0.1) bend = std::max(0.7 * bend, std::min(1.0, size / (last * last)));
        if (bend * size * size <= near_enough && (size < 10 || last > 0)) return Way::arrived;
        return tries >= most_iterations || (last > 0 && size > 2 * last && tries > 3) ? Way::lost : Way::on;
    }
};

}  // namespace corpuscle::circuit
