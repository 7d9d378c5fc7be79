#include "circuit/cost/area.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle::circuit {
namespace {

constexpr double max_rows_of_array = 4096;  // array_area() tries no more

}  // namespace

Area& Area::operator+=(const Area& more) {
    gates += more.gates, arrays += more.arrays, islands += more.islands, capacitors += more.capacitors;
    return *this;
}

double rectangle_area(double W, double L, double rows, double columns) {
    using Rule = RectangleRule;
    return (rows * W + (rows - 1) * Rule::between_W + Rule::around_W) * (columns * L + (columns - 1) * Rule::between_L + Rule::around_L);
}

double array_area(double W, double L, double unit_transistors) {
    double smallest = rectangle_area(W, L, 1, std::ceil(unit_transistors));
    for (double rows = 2; rows <= std::min(std::ceil(unit_transistors), max_rows_of_array); ++rows)
        smallest = std::min(smallest, rectangle_area(W, L, rows, std::ceil(unit_transistors / rows)));
    return smallest;
}

}  // namespace corpuscle::circuit
