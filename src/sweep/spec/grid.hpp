#pragma once
// A full grid: every combination of the listed values once, without random samples. So the effects of the axes are exact and need no
// statistical test.

#include "sweep/stats/sweep_table.hpp"

namespace corpuscle {

/// The effect of one axis on a measure: the mean of the measure at each value of the axis, over all values of the other axes.
struct AxisEffect {
    std::size_t axis = 0;       ///< index in the table's axes
    double fraction = 0;        ///< fraction of the measure's variance over the grid that lies between these means
    std::vector<double> means;  ///< one for each value in SweepTable::points[axis]; NaN: no item with this value has the measure
};

/// True if the sweep samples neither chips nor values of an axis.
bool is_deterministic(const SweepResults&);

/// Effects of all axes with at least two values, the largest fraction first; empty if the measure does not vary. `measure`: its value in
/// each row of the table.
std::vector<AxisEffect> axis_effects(const SweepTable&, const std::vector<double>& measure);

/// Means of the measure at each pair of values of the axes with indexes a and b: [index of a's value][index of b's value].
std::vector<std::vector<double>> means_over(const SweepTable&, const std::vector<double>& measure, std::size_t a, std::size_t b);

/// The values of all axes in one row of the table, such as "press.F_max = 2 N, sa1.f_B = 20 Hz".
std::string point_label(const SweepTable&, std::size_t row);

}  // namespace corpuscle
