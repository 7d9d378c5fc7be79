#pragma once
// Measures of spike trains. To add one, put its struct into a file of this folder and its name into the list Measures. It is then a column
// of the summary, the tables and the report. A measure receives the spikes one after another, and stores a few numbers however long the
// train is.

#include <span>
#include <tuple>
#include <vector>

#include "measure/intervals.hpp"
#include "measure/phase_locking.hpp"
#include "measure/rates.hpp"

namespace corpuscle {

template <class... M>
struct MeasureList {
    using Tuple = std::tuple<M...>;
    static constexpr MeasureInfo infos[] = {M::info...};
};
using Measures = MeasureList<SpikeCount, MeanRate, PeakRate, FirstRate, LastRate, Latency, AdaptationRatio, IntervalVariation,
                             VectorStrength, Entrainment>;

/// The descriptions of all measures, in the order of the list.
inline constexpr auto& measures = Measures::infos;

/// The index of a measure in `measures`.
template <class M>
inline constexpr std::size_t measure_index = [] {
    std::size_t k = 0;
    while (measures[k].name != M::info.name) ++k;
    return k;
}();

/// Computes every measure of every train in every time window.
class MeasureAccumulator {
    struct Train {
        std::vector<Measures::Tuple> measures;  // for each window, one object of each measure
        std::size_t window = 0;                 // index of the first window that ends after the latest spike
        double last = no_value;                 // time of the latest spike, s; NaN if it was in no window
    };
    std::vector<TimeWindow> windows_;
    std::vector<Train> trains_;

public:
    /// `trains` is the number of trains. The windows must be in order of time and must not overlap.
    explicit MeasureAccumulator(std::vector<TimeWindow> windows = {}, std::size_t trains = 0);
    /// Adds the next spike of the train with this index (counted from 0), at time t in s. The spikes of one train come in order of time.
    void spike(std::size_t train_index, double t);
    /// Sets the end of the windows whose end is not known (infinite) to t, in s.
    void set_end(double t);
    /// The values of one train in one window, in the order of corpuscle::measures; no_value for an undefined one.
    std::vector<double> values(std::size_t train, std::size_t window) const;
    template <class M>
    double value(std::size_t train, std::size_t window) const {
        return std::get<M>(trains_[train].measures[window]).value(windows_[window]);
    }
};

/// One measure of a complete train (spike times in s) in one window: measure<PeakRate>(train, {0.25, 0.375}).
template <class M>
double measure(std::span<const double> train, const TimeWindow& window) {
    MeasureAccumulator accumulator({window}, 1);
    for (const double t : train) accumulator.spike(0, t);
    return accumulator.value<M>(0, 0);
}

/// The instantaneous frequencies of a train (spike times in s), in Hz: one at each spike except the last one.
__attribute__((visibility("default"))) std::vector<double> instantaneous_rates(std::span<const double> train);

}  // namespace corpuscle
