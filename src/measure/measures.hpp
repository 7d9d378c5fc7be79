#pragma once
// Spikes to numbers. A new measure: its struct in a file here, and its name in the list; it is then a column in summary, table and
// report. Measures take spikes as they come and keep a few numbers each, however long the train.

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

/// Where a measure stands among `measures`.
template <class M>
inline constexpr std::size_t place_of_measure = [] {
    std::size_t k = 0;
    while (measures[k].name != M::row.name) ++k;
    return k;
}();

/// Every measure of every train in every stretch.
class Tally {
    struct Train {
        std::vector<Measures::Held> in;  // each stretch
        std::size_t at = 0;              // the stretch of the last spike, or the one after it
        double last = no_value;          // s; none if that spike was in no stretch
    };
    std::vector<Stretch> stretches_;
    std::vector<Train> trains_;

public:
    /// The stretches are in order of time and do not overlap.
    explicit Tally(std::vector<Stretch> stretches = {}, std::size_t trains = 0);
    /// The next spike of a train, at t (s).
    void spike(std::size_t train, double t);
    /// An end that was not known is here.
    void end(double t);
    /// A value for each of `measures`.
    std::vector<double> values(std::size_t train, std::size_t stretch) const;
    template <class M>
    double value(std::size_t train, std::size_t stretch) const {
        return std::get<M>(trains_[train].in[stretch]).value(stretches_[stretch]);
    }
};

/// One measure of a train that is at hand whole: measure<PeakRate>(train, {0.25, 0.375}).
template <class M>
double measure(std::span<const double> train, const Stretch& stretch) {
    Tally tally({stretch}, 1);
    for (const double t : train) tally.spike(0, t);
    return tally.value<M>(0, 0);
}

/// The instantaneous frequencies of a train, one fewer than its spikes; Hz.
std::vector<double> instantaneous_rates(std::span<const double> train);

}  // namespace corpuscle
