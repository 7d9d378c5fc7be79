#include "circuit/cost/area.hpp"

#include <algorithm>
#include <cmath>

#include "circuit/device/named_values.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double um = 1e-6;                 // m
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

Area area_of(const Element& e) {
    Area out;
    if (e.letter == 'c' && !e.expression) out.capacitors = std::abs(e.value) * value_or(e.values, "m", 1) / capacitor_density;
    if (e.letter != 'm') return out;
    const double W = value_or(e.values, "w", 1 * um), L = value_or(e.values, "l", 1 * um);
    const double units = value_or(e.values, "m", 1) * value_or(e.values, "stack", 1);
    out.gates = units * W * L, out.arrays = array_area(W, L, units), out.islands = units * rectangle_area(W, L, 1, 1);
    return out;
}

}  // namespace corpuscle::circuit
