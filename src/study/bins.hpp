#pragma once
// Counts of rows in even bins of time, put out as CSV when a bin is full.

#include <fmt/format.h>
#include <string>
#include <string_view>
#include <vector>

#include "signal/error.hpp"
#include "signal/spike.hpp"

namespace corpuscle {

/// Bins are counted from the start; the last one ends with the input. A bin owns its start, not its end; a spike that misses an edge by
/// less than 1e-9 of a bin stands on it.
class EvenBins {
public:
    /// What a bin's line begins with, and among how many its rate is shared.
    struct Row {
        std::string name;
        double units = 1;
    };

    /// Refuses a bin shorter than a hundredth of the samples' period: there are more lines of it than spikes can fill.
    static Result<void> check(const Clock&, double bin);

    EvenBins() = default;
    EvenBins(std::vector<Row> rows, const Clock& clock, double bin);
    void count(const Spike& s, std::size_t row);
    /// What comes from now on is behind this sample.
    void known_to(std::int64_t sample);
    /// The input had so many samples.
    void end(std::int64_t samples);
    /// The lines of the bins that were done since the last call: name,from_s,to_s,spikes,rate_Hz. Valid until more is counted.
    std::string_view lines();

private:
    std::vector<Row> rows_;
    Clock since_start_;
    double bin_ = 1, t0_ = 0;        // s; t0: of the input, by the clock of the spikes' file
    std::int64_t at_ = 0;            // the bin that fills
    std::vector<std::int64_t> now_;  // spikes in it, of each row
    fmt::memory_buffer text_;
    bool told_ = false;

    std::int64_t bin_of(double t) const;
    void put(double to);
    void fill_up_to(std::int64_t bin);
};

}  // namespace corpuscle
