#pragma once
// Spikes to numbers. A measure is one function of a train and a phase; each is a column in summary, table and report.

#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "signal/source.hpp"

namespace corpuscle {

/// A train of spike times (s, in order) and the phase that is measured, [phase.from, phase.to).
struct Stretch {
    std::span<const double> train;
    std::size_t begin, end;  ///< of the phase's spikes in the train
    Phase phase;

    Stretch(std::span<const double> train, const Phase& phase);
    std::size_t count() const { return end - begin; }
    /// The thesis's instantaneous frequency, 1 / (t[k+1] - t[k]), drawn at t[k] (3.3); the last spike of all has none.
    /// Two spikes on one sample have none, either.
    double rate_at(std::size_t k) const {
        const double interval = train[k + 1] - train[k];
        return interval > 0 ? 1 / interval : std::numeric_limits<double>::quiet_NaN();
    }
};

struct Measure {
    std::string_view name;   ///< in files: "peak_rate"
    std::string_view title;  ///< for people: "peak rate"
    std::string_view unit, sentence;
    double (*of)(const Stretch&);  ///< NaN where it has no meaning
};

double spike_count(const Stretch&);
double mean_rate(const Stretch&);
double peak_rate(const Stretch&);
double first_rate(const Stretch&);
double last_rate(const Stretch&);

inline constexpr Measure measures[] = {
    {"spikes", "spikes", "", "spikes in the phase", spike_count},
    {"mean_rate", "mean", "Hz", "spikes in the phase over its length", mean_rate},
    {"peak_rate", "peak", "Hz", "highest instantaneous frequency at a spike of the phase", peak_rate},
    {"first_rate", "first", "Hz", "instantaneous frequency at the phase's first spike", first_rate},
    {"last_rate", "last", "Hz", "last instantaneous frequency between two spikes of the phase", last_rate},
};

/// The instantaneous frequencies of a train, one fewer than its spikes; Hz.
std::vector<double> instantaneous_rates(std::span<const double> train);

}  // namespace corpuscle
