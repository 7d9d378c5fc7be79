#pragma once
// Counts spikes in time bins of equal width and writes each full bin as CSV.

#include <fmt/format.h>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/spike.hpp"
#include "run/population.hpp"

namespace corpuscle {

/// The first bin begins with the input; the last one ends with the input and may be shorter. A bin includes its start and excludes its end.
/// A spike closer to an edge than 1e-9 bin widths counts as at the edge.
class TimeBins {
public:
    using Group = BinGroups::Group;

    /// Returns an error if bins are shorter than a hundredth of the sample period, because almost all of them would be empty. `bin_width`
    /// in s.
    static Result<void> check(const Clock&, double bin_width);

    TimeBins() = default;
    TimeBins(std::vector<Group> groups, const Clock& clock, double bin_width);
    /// Counts a spike of a group. Spikes must come in order of time. Completes the bins that end before the spike.
    void count(const Spike& s, std::size_t group);
    /// Tells that all spikes still to come are after this sample, counted from 0. Completes the bins that end before it.
    void advance_to(std::int64_t sample);
    /// Tells that the input has ended after this many samples. Completes the last bin.
    void end(std::int64_t samples);
    /// Lines of the bins completed since the last call: name,from_s,to_s,spikes,rate_Hz, with times on the clock of the input. Valid until
    /// the next call of another function.
    std::string_view take_lines();

private:
    std::vector<Group> groups_;
    Clock since_start_;                 // of the input, with its first sample at 0 s
    double bin_width_ = 1;              // s
    double t0_ = 0;                     // s, start of the input on its own clock
    std::int64_t current_bin_ = 0;      // index of the current bin, from 0
    std::vector<std::int64_t> counts_;  // spikes in the current bin, for each group
    fmt::memory_buffer text_;           // lines of complete bins
    bool lines_taken_ = false;          // true if take_lines() has returned text_, so that it can be cleared

    std::int64_t bin_index(double t) const;  // t: s since the start
    void end_bin(double to);
    void end_bins_before(std::int64_t bin);
};

}  // namespace corpuscle
