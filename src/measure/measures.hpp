#pragma once
// Measures of spike trains. To add one, put its struct into a file here and its name into the list. It is then a column in summary, table
// and report. Measures receive spikes one at a time and store a few numbers, independent of the length of the train.

#include <span>
#include <tuple>
#include <vector>

#include "measure/adaptation.hpp"
#include "measure/interval_variation.hpp"
#include "measure/latency.hpp"
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
        std::vector<Measures::Tuple> measures;  // one for each window
        std::size_t window = 0;                 // the window of the last spike, or the next one
        double last = no_value;                 // s; NaN if that spike was in no window
    };
    std::vector<TimeWindow> windows_;
    std::vector<Train> trains_;

public:
    /// The windows are in order of time and do not overlap.
    explicit MeasureAccumulator(std::vector<TimeWindow> windows = {}, std::size_t trains = 0);
    /// Adds the next spike of a train, at t (s).
    void spike(std::size_t train, double t);
    /// Sets the end of windows whose end was unknown.
    void set_end(double t);
    /// A value for each of `measures`; no_value if a measure is undefined.
    std::vector<double> values(std::size_t train, std::size_t window) const;
    template <class M>
    double value(std::size_t train, std::size_t window) const {
        return std::get<M>(trains_[train].measures[window]).value(windows_[window]);
    }
};

/// One measure of a complete train: measure<PeakRate>(train, {0.25, 0.375}).
template <class M>
double measure(std::span<const double> train, const TimeWindow& window) {
    MeasureAccumulator accumulator({window}, 1);
    for (const double t : train) accumulator.spike(0, t);
    return accumulator.value<M>(0, 0);
}

/// The instantaneous frequencies of a train, Hz; one value fewer than its spikes.
std::vector<double> instantaneous_rates(std::span<const double> train);

}  // namespace corpuscle
