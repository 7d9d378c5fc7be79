#pragma once
// A full grid: every combination of listed values once, without random samples. Effects need no inference and are reported exactly.

#include "study/sweep/sweep_table.hpp"

namespace corpuscle {

/// The effect of one axis on a measure: the mean at each value of the axis (SweepTable::points), over all values of the other axes.
struct AxisEffect {
    std::size_t axis = 0;
    double fraction = 0;        ///< fraction of the measure's variance over the grid that lies between these means
    std::vector<double> means;  ///< NaN: no item has the measure there
};

/// True if the sweep samples neither chips nor values of an axis.
bool is_deterministic(const SweepResults&);

/// Effects of all axes with at least two values, the strongest first; empty if the measure does not vary.
std::vector<AxisEffect> axis_effects(const SweepTable&, const std::vector<double>& measure);

/// Means of the measure at each pair of values of two axes, [value of a][value of b].
std::vector<std::vector<double>> means_over(const SweepTable&, const std::vector<double>& measure, std::size_t a, std::size_t b);

/// "press.F_max = 2 N, sa1.f_B = 20 Hz": the values of all axes in a row.
std::string point_label(const SweepTable&, std::size_t row);

}  // namespace corpuscle
