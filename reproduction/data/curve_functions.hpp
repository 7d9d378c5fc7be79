#pragma once
// Functions of curves and spike trains that the expressions in data files use, besides those of StudyCurve. NaN stands for a value that the
// curve does not have.

#include "measure/measure_base.hpp"
#include "reproduction/claims/study_curve.hpp"

namespace corpuscle {

// ---- curves from curves ----

StudyCurve moved_along_x(StudyCurve, double by_x);
StudyCurve moved(StudyCurve, double by_x, double by_y);
/// The value of `outer` at each y of `inner`, over the x of `inner`.
StudyCurve composed(const StudyCurve& outer, const StudyCurve& inner);
/// The y of a curve over the y of another one at the same x, in the order of rising values of the other one.
StudyCurve over(const StudyCurve& curve, const StudyCurve& other);
/// The pairs with y above a level.
StudyCurve above(const StudyCurve&, double level);
/// The part of a sweep up and down again in which x rises, and the part in which it falls, the latter in order of rising x.
StudyCurve rising_part(const StudyCurve&);
StudyCurve falling_part(const StudyCurve&);
/// The curve y = x from `from` to `to`: with this number of points in a decade, or in equal steps.
StudyCurve decades(double from, double to, double points);
StudyCurve steps(double from, double to, double step);

// ---- numbers from curves ----

/// The largest |y|; points where y is NaN do not count. 0 if there are no points.
double largest(const StudyCurve&);
/// The largest absolute difference between the y of two neighbours.
double largest_step(const StudyCurve&);
/// 1 if no y is smaller than the one before; otherwise 0.
double is_rising(const StudyCurve&);
/// 1 if each y is smaller than the one before; otherwise 0.
double is_falling(const StudyCurve&);
/// The distance between the first and the last x at which y is at least `level`.
double range_above(const StudyCurve&, double level);
/// The longest range of x in which y stays at or above `level`.
double longest_time_above(const StudyCurve&, double level);
/// The first and the last x at which y is at most `level`.
double first_x_below(const StudyCurve&, double level);
double last_x_below(const StudyCurve&, double level);
/// The largest x below `from`, one of the curve's x, at which the curve crosses the level; the first x if y is above the level up to there.
double last_crossing(const StudyCurve&, double level, double from);
/// Half the width of the range around `middle` in which y is within 5 % of its value there.
double flat_range(const StudyCurve&, double middle);
/// The integral of the part of a curve above a level, by the trapezoidal rule.
double integral_above(const StudyCurve&, double level);
/// The charge of a current within a window, each sample times the time since the one before.
double charge(const StudyCurve& current, const TimeWindow&);
/// The number of sudden falls of a membrane voltage by more than a tenth of its largest value.
double count_resets(const StudyCurve& u);
/// The smallest jump of a curve at a spike. The jump is a ratio: the largest value within `duration` (s) after the spike, over the largest
/// value before it (from 2 to 0.5 times `duration` before). Infinity if there are no spikes.
double min_jump_ratio(const StudyCurve&, const std::vector<double>& spikes, double duration);

// ---- lists ----

/// The spikes of a train before a time.
std::vector<double> before(const std::vector<double>& train, double time);
/// The differences between neighbours.
std::vector<double> intervals(const std::vector<double>& train);
/// The element with this index, counted from 0.
double element(const std::vector<double>&, double index);

}  // namespace corpuscle
