#include "reproduction/thesis/active_load.hpp"

#include <algorithm>
#include <utility>

namespace corpuscle {

ActiveLoad analyse_load(StudyCurve current, double tolerance) {
    ActiveLoad out;
    out.current = std::move(current);
    out.resistance = out.current.slope().inverse();
    out.zero_current_voltage = out.current.crossing(0);
    out.max_resistance = out.resistance.max(), out.max_resistance_at = out.resistance.x_of_max();
    const double min_resistance = (1 - tolerance) * out.max_resistance;
    out.linear_to = out.resistance.crossing(min_resistance, out.max_resistance_at);
    const auto& [x, y] = out.resistance;
    auto k = static_cast<std::size_t>(std::max_element(y.begin(), y.end()) - y.begin());
    while (k > 0 && y[k - 1] >= min_resistance) --k;
    out.linear_from = k == 0 ? x[0] : x[k - 1] + (x[k] - x[k - 1]) * (min_resistance - y[k - 1]) / (y[k] - y[k - 1]);
    return out;
}

}  // namespace corpuscle
