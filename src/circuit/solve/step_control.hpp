#pragma once
// How long a transient's steps are, of what order, and when Newton's way to the end of one is over: numbers alone, whatever they are of.

#include <algorithm>
#include <cmath>

#include "signal/elementary.hpp"

namespace corpuscle::circuit {

/// Length and order of the next step of BDF.
struct StepControl {
    int order = 1, since_choice = 0, failures = 0;
    bool starting = true;  ///< since the start every step has been of the highest order its points allow
    double h = 0;          ///< s
    double calm = 0;       ///< s: the longest of the last steps, less the longer ago it was

    static constexpr double safety = 0.65;  ///< a step that has to be taken again costs more than some shorter ones
    static constexpr double longer = 2;     ///< no step is so many times as long as the last
    static constexpr double curved = 2;     ///< allowed units: how far a curve between two points may be off
    static constexpr int curve_points = 5;  ///< at the most, of the polynomial between two points

    /// How much longer a step of this order may be, for an error of one allowed unit.
    static double growth(double error, int order) {
        return error > 0 ? std::min(safety * num::exp(num::log(error) / -(order + 1)), 10.0) : 10;
    }

    void start_over() { order = 1, since_choice = 0, starting = true; }

    /// Whether the errors of the next lower and higher order are wanted for choose().
    bool looks_around() const { return since_choice > order || starting; }
    bool can_fall() const { return order > 1; }
    bool can_rise(int highest, int points) const { return order < highest && points > order + 1; }

    /// After a step of this length and error, with so many points before it and orders up to `highest`. error_of(order) gives the others'.
    template <class ErrorOf>
    void choose(double taken, double error, int points, int highest, ErrorOf&& error_of) {
        double most = growth(error, order);
        if (looks_around()) {
            since_choice = 0;
            const double lower = can_fall() ? 0.9 * growth(error_of(order - 1), order - 1) : 0;
            const double higher = can_rise(highest, points) ? 0.9 * growth(error_of(order + 1), order + 1) : 0;
            if (lower > most && lower > higher)
                --order, most = lower, starting = false;
            else if (higher > most)
                ++order, most = higher;
            else if (starting && order < highest)
                ++order;
        }
        stretch(taken, most, points);
    }
    /// After choose(): no longer than the curve between two points allows, which is off by so many times what it may be.
    void hold(double taken, double bend, int curve) { h = std::min(h, taken * std::clamp(growth(bend, curve - 1), 0.3, longer)); }
    void took(double step) { calm = std::max(step, 0.7 * calm); }
    /// A step no longer than this may hold a jump: what has no charge then counts at its ends alone, and a straight line lies between.
    double jump(double reltol, double longest) const { return std::max(reltol * calm, 1e-9 * longest); }
    void stretch(double taken, double by, int points) { h = taken * std::clamp(by, 0.3, points < 3 ? 5 : longer); }

    /// After one that was too long by its error, or whose equations were not solved (0). True: all is to begin anew, from the last point;
    /// `before`: how long the last step was, 0 if there was none since the start; `patience`: how often it may fail before that.
    bool shorten(double taken, double error, double before, int patience = 1) {
        ++failures;
        h = taken * (error > 0 ? std::clamp(growth(error, order), before > 0 ? 0.1 : 1e-3, 0.8) : 0.125);
        return before > 0 && (failures > patience || h < 0.1 * before);
    }
};

/// Newton's steps towards the end of one in time.
struct NewtonControl {
    enum class Way { on, arrived, lost };
    static constexpr int most_iterations = 12;
    static constexpr double near_enough = 0.03;  ///< of what is allowed: what an iteration may leave over

    int tries = 0;
    double before = 0;  ///< the last one's size, in allowed units; 0: it was cut short
    double bend = 1;    ///< how much of a squared step is left after it

    void begin() { tries = 0, before = 0; }
    /// It is not there after all, for a reason that no step's size tells.
    Way not_yet() const { return tries < most_iterations ? Way::on : Way::lost; }
    /// After a step of this size, of equations that are not straight; `cut`: it was made shorter, or looked elsewhere than it stood.
    Way after(double size, bool cut) {
        const double last = before;
        before = cut ? 0 : size, ++tries;
        if (cut) return tries < most_iterations ? Way::on : Way::lost;
        if (last > 0.1) bend = std::max(0.7 * bend, std::min(1.0, size / (last * last)));
        if (bend * size * size <= near_enough && (size < 10 || last > 0)) return Way::arrived;
        return tries >= most_iterations || (last > 0 && size > 2 * last && tries > 3) ? Way::lost : Way::on;
    }
};

}  // namespace corpuscle::circuit
