#pragma once
// Measures of spike trains. To add one, put its struct into a file here and its name into the list. It is then a column in summary, table
// and report. Measures receive spikes one by one and keep a few numbers each, independent of the length of the train.

#include <span>
#include <tuple>
#include <vector>

#include "measure/adaptation.hpp"
#include "measure/latency.hpp"
#include "measure/locking.hpp"
#include "measure/rates.hpp"
#include "measure/regularity.hpp"

namespace corpuscle {

template <class... M>
struct MeasureList {
    using Held = std::tuple<M...>;
    static constexpr Measure rows[] = {M::row...};
};
using Measures = MeasureList<SpikeCount, MeanRate, PeakRate, FirstRate, LastRate, Latency, AdaptationRatio, IntervalVariation,
                             VectorStrength, Entrainment>;

inline constexpr auto& measures = Measures::rows;

/// The index of a measure in `measures`.
template <class M>
inline constexpr std::size_t place_of_measure = [] {
    std::size_t k = 0;
    while (measures[k].name != M::row.name) ++k;
    return k;
}();

/// Computes every measure of every train in every time window.
class Tally {
    struct Train {
        std::vector<Measures::Held> in;  // one for each window
        std::size_t at = 0;              // the window of the last spike, or the next one
        double last = no_value;          // s; NaN if that spike was in no window
    };
    std::vector<Stretch> stretches_;
    std::vector<Train> trains_;

public:
    /// The windows are in order of time and do not overlap.
    explicit Tally(std::vector<Stretch> stretches = {}, std::size_t trains = 0);
    /// The next spike of a train, at t (s).
    void spike(std::size_t train, double t);
    /// Sets the end of windows whose end was unknown.
    void end(double t);
    /// A value for each of `measures`.
    std::vector<double> values(std::size_t train, std::size_t stretch) const;
    template <class M>
    double value(std::size_t train, std::size_t stretch) const {
        return std::get<M>(trains_[train].in[stretch]).value(stretches_[stretch]);
    }
};

/// One measure of a complete train: measure<PeakRate>(train, {0.25, 0.375}).
template <class M>
double measure(std::span<const double> train, const Stretch& stretch) {
    Tally tally({stretch}, 1);
    for (const double t : train) tally.spike(0, t);
    return tally.value<M>(0, 0);
}

/// The instantaneous frequencies of a train, Hz; one value fewer than its spikes.
std::vector<double> instantaneous_rates(std::span<const double> train);

}  // namespace corpuscle
