// The list of measures. To add one, put its struct into a file of this folder, and its include and its name below. It is then a column of
// the summary, the tables and the report. A measure receives the spikes one after another, and stores a few numbers however long the train
// is.

#include "measure/measures.hpp"

#include <algorithm>
#include <tuple>

#include "measure/intervals.hpp"
#include "measure/phase_locking.hpp"
#include "measure/rates.hpp"

namespace corpuscle {
namespace {

template <class... M>
struct MeasureList {
    using Tuple = std::tuple<M...>;
    static constexpr MeasureInfo infos[] = {M::info...};
};
using Measures = MeasureList<SpikeCount, MeanRate, PeakRate, FirstRate, LastRate, Latency, AdaptationRatio, IntervalVariation,
                             VectorStrength, Entrainment>;

/// Calls f with each measure.
template <class Tuple, class F>
void each(Tuple& all, F&& f) {
    std::apply([&](auto&... m) { (f(m), ...); }, all);
}

}  // namespace

constinit const std::span<const MeasureInfo> measures = Measures::infos;

std::size_t measure_index(std::string_view name) {
    return static_cast<std::size_t>(std::ranges::find(measures, name, &MeasureInfo::name) - measures.begin());
}

struct MeasureAccumulator::Train {
    std::vector<Measures::Tuple> measures;  // for each window, one object of each measure
    std::size_t window = 0;                 // index of the first window that ends after the latest spike
    double last = no_value;                 // time of the latest spike, s; NaN if it was in no window
};

MeasureAccumulator::MeasureAccumulator(std::vector<TimeWindow> windows, std::size_t trains)
    : windows_(std::move(windows)), trains_(trains, Train{std::vector<Measures::Tuple>(windows_.size())}) {}

MeasureAccumulator::MeasureAccumulator(MeasureAccumulator&&) noexcept = default;
MeasureAccumulator& MeasureAccumulator::operator=(MeasureAccumulator&&) noexcept = default;
MeasureAccumulator::~MeasureAccumulator() = default;

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

bool remove_unresolved_rates(std::vector<double>& values, double T) {
    constexpr double tolerance = 1e-3;  // for spikes on the samples themselves, which are one sample apart except for rounding
    bool any = false;
    for (const auto m : {measure_index<MeanRate>(), measure_index<PeakRate>(), measure_index<FirstRate>(), measure_index<LastRate>()})
        if (values[m] * T > 1 + tolerance) values[m] = no_value, any = true;
    return any;
}

}  // namespace corpuscle
