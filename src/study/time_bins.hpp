#pragma once
// Counts spikes in time bins of equal width and writes each full bin as CSV.

#include <fmt/format.h>
#include <string>
#include <string_view>
#include <vector>

#include "signal/error.hpp"
#include "signal/spike.hpp"

namespace corpuscle {

/// Bins are counted from the start; the last one ends with the input. A bin includes its start and excludes its end. A spike within 1e-9 of
/// a bin width of an edge is at the edge.
class TimeBins {
public:
    /// The first columns of a bin's line, and the number of afferents over which its rate is averaged.
    struct Group {
        std::string name;
        double afferents = 1;
    };

    /// Rejects a bin shorter than a hundredth of the sample period: it would give more lines than there can be spikes.
    static Result<void> check(const Clock&, double bin);

    TimeBins() = default;
    TimeBins(std::vector<Group> groups, const Clock& clock, double bin);
    /// Counts a spike of a group, in order of time. Ends the bins before the spike.
    void count(const Spike& s, std::size_t group);
    /// States that all later spikes come after this sample, and ends the bins before it.
    void advance_to(std::int64_t sample);
    /// States that the input had this many samples, and ends the last bin.
    void end(std::int64_t samples);
    /// Lines of the bins completed since the last call: name,from_s,to_s,spikes,rate_Hz. Valid until the next count.
    std::string_view take_lines();

private:
    std::vector<Group> groups_;
    Clock since_start_;
    double bin_width_ = 1, t0_ = 0;     // s; t0_: start of the input on the clock of the spike file
    std::int64_t current_bin_ = 0;      // index of the current bin
    std::vector<std::int64_t> counts_;  // spikes in the current bin, for each group
    fmt::memory_buffer text_;
    bool lines_taken_ = false;

    std::int64_t bin_index(double t) const;
    void end_bin(double to);
    void end_bins_before(std::int64_t bin);
};

}  // namespace corpuscle
