#include "measure/measures.hpp"

namespace corpuscle {
namespace {

/// Calls f with each measure.
template <class Tuple, class F>
void each(Tuple& all, F&& f) {
    std::apply([&](auto&... m) { (f(m), ...); }, all);
}

}  // namespace

MeasureAccumulator::MeasureAccumulator(std::vector<TimeWindow> windows, std::size_t trains)
    : windows_(std::move(windows)), trains_(trains, Train{std::vector<Measures::Tuple>(windows_.size())}) {}

void MeasureAccumulator::spike(std::size_t train_index, double t) {
    auto& train = trains_[train_index];
    // The window of the spike before this one, if that spike was in a window (train.last is then not NaN).
    const std::size_t previous_window = train.window;
    while (train.window < windows_.size() && t >= windows_[train.window].to) ++train.window;
    const bool is_inside = train.window < windows_.size() && t >= windows_[train.window].from;
    if (!std::isnan(train.last))
        each(train.measures[previous_window], [&](auto& m) { m.interval(train.last, t, is_inside && train.window == previous_window); });
    if (is_inside) each(train.measures[train.window], [&](auto& m) { m.spike(t, windows_[train.window]); });
    train.last = is_inside ? t : no_value;
}

void MeasureAccumulator::set_end(double t) {
    for (auto& window : windows_)
        if (std::isinf(window.to)) window.to = t;
}

std::vector<double> MeasureAccumulator::values(std::size_t train, std::size_t window) const {
    std::vector<double> all;
    each(trains_[train].measures[window], [&](const auto& m) { all.push_back(m.value(windows_[window])); });
    return all;
}

std::vector<double> instantaneous_rates(std::span<const double> train) {
    std::vector<double> rates;
    for (std::size_t k = 0; k + 1 < train.size(); ++k) rates.push_back(rate_between(train[k], train[k + 1]));
    return rates;
}

}  // namespace corpuscle
