#pragma once
// Measures of spike trains. Their list is in measures.cpp.

#include <span>
#include <string_view>
#include <vector>

#include "measure/intervals.hpp"
#include "measure/phase_locking.hpp"
#include "measure/rates.hpp"

namespace corpuscle {

/// The descriptions of all measures, in the order of their list (measures.cpp).
extern const std::span<const MeasureInfo> measures;

/// The index in `measures` of the measure with this name, which exists.
std::size_t measure_index(std::string_view name);

/// The index in `measures` of a measure.
template <class M>
std::size_t measure_index() {
    return measure_index(M::info.name);
}

/// Computes every measure of every train in every time window.
class MeasureAccumulator {
    struct Train;
    std::vector<TimeWindow> windows_;
    std::vector<Train> trains_;

public:
    /// `trains` is the number of trains. The windows must be in order of time and must not overlap.
    explicit MeasureAccumulator(std::vector<TimeWindow> windows = {}, std::size_t trains = 0);
    MeasureAccumulator(MeasureAccumulator&&) noexcept;
    MeasureAccumulator& operator=(MeasureAccumulator&&) noexcept;
    ~MeasureAccumulator();
    /// Adds the next spike of the train with this index (counted from 0), at time t in s. The spikes of one train come in order of time.
    void spike(std::size_t train_index, double t);
    /// Sets the end of the windows whose end is not known (infinite) to t, in s.
    void set_end(double t);
    /// The values of one train in one window, in the order of corpuscle::measures; no_value for an undefined one.
    std::vector<double> values(std::size_t train, std::size_t window) const;
};

/// Removes the rates among the values of all `measures` that come from two spikes within one sample (T, s). They would be multiples of the
/// sample rate, and say only that the force is too large for an afferent without a refractory time. Returns true if there are any.
bool remove_unresolved_rates(std::vector<double>& values, double T);

/// One measure of a complete train (spike times in s) in one window: measure<PeakRate>(train, {0.25, 0.375}).
template <class M>
double measure(std::span<const double> train, const TimeWindow& window) {
    MeasureAccumulator accumulator({window}, 1);
    for (const double t : train) accumulator.spike(0, t);
    return accumulator.values(0, 0)[measure_index<M>()];
}

/// The instantaneous frequencies of a train (spike times in s), in Hz: one at each spike except the last one.
__attribute__((visibility("default"))) std::vector<double> instantaneous_rates(std::span<const double> train);

}  // namespace corpuscle
