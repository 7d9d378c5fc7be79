#pragma once
// A plain grid: every combination of listed values once, nothing drawn by chance. There is nothing to infer: what each axis does is told
// as it is.

#include "study/sweep/sweep_table.hpp"

namespace corpuscle {

/// What one axis does to a measure: its mean at each value of the axis (SweepTable::points), over all values of the other axes.
struct AxisEffect {
    std::size_t axis = 0;
    double share = 0;           ///< of the measure's variance over the grid, that lies between these means
    std::vector<double> means;  ///< NaN: no unit has the measure there
};

/// Whether the sweep draws nothing: neither chips nor values of an axis.
bool draws_nothing(const SweepResults&);

/// Of every axis of two values or more, the strongest first; none if the measure does not vary.
std::vector<AxisEffect> effects_of(const SweepTable&, const std::vector<double>& measure);

/// The measure's means at each pair of values of two axes, [value of a][value of b].
std::vector<std::vector<double>> means_over(const SweepTable&, const std::vector<double>& measure, std::size_t a, std::size_t b);

/// "press.F_max = 2 N, sa1.f_B = 20 Hz": all axes of a row.
std::string point_label(const SweepTable&, std::size_t row);

}  // namespace corpuscle
