#include "study/thesis/load.hpp"

#include <algorithm>
#include <utility>

namespace corpuscle {

Load load_of(Line current, double tolerance) {
    Load out;
    out.current = std::move(current);
    out.resistance = out.current.slope().inverse();
    out.rest = out.current.where(0);
    out.most = out.resistance.most(), out.at = out.resistance.peak();
    const double min_resistance = (1 - tolerance) * out.most;
    out.to = out.resistance.where(min_resistance, out.at);
    const auto& [x, y] = out.resistance;
    auto k = static_cast<std::size_t>(std::max_element(y.begin(), y.end()) - y.begin());
    while (k > 0 && y[k - 1] >= min_resistance) --k;
    out.from = k == 0 ? x[0] : x[k - 1] + (x[k] - x[k - 1]) * (min_resistance - y[k - 1]) / (y[k] - y[k - 1]);
    return out;
}

}  // namespace corpuscle
