#pragma once
// The processing of one channel from file values to newtons: outlier removal, gap filling, offset and gain, filters. Fault detectors
// examine the channel on the way.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/filter.hpp"
#include "io/mend.hpp"
#include "io/quality.hpp"
#include "io/recording.hpp"

namespace corpuscle {

/// Statistics of a channel's force relative to the range that the models are fitted to (thesis 1.2: 0.2 to 4 N).
struct Levels {
    double least = 1e308, greatest = -1e308;
    std::int64_t below = 0, above = 0, negative = 0, count = 0;
    void add(std::span<const double>);
    double share(std::int64_t n) const { return count > 0 ? static_cast<double>(n) / static_cast<double>(count) : 0; }
};

class ChannelPath {
    std::optional<StrayFilter> strays_;
    GapFiller gaps_;
    double offset_, gain_;
    std::vector<Biquad> filters_;
    bool filter_early_;                    // true: filter the evenly spaced rows; false: filter after resampling
    std::vector<double> judged_, mended_;  // scratch memory

    Result<void> mend(std::span<const double> read);

public:
    /// `filters` is the clock that the filters run on.
    static Result<ChannelPath> make(const RecordingOptions&, double gain, const Clock& filters, bool filter_early, const HumTable&);

    StrayCheck stray_check;
    SaturationCheck saturation;
    HumCheck hum;
    Levels levels;

    double gain() const { return gain_; }
    double offset() const { return offset_; }
    std::int64_t strays_taken_out() const { return strays_ ? strays_->found : 0; }
    std::int64_t filled() const { return gaps_.filled; }

    /// Processes samples and appends newtons to `out`. Samples that depend on their neighbours are appended by a later call.
    Result<void> push(std::span<const double> read, std::vector<double>& out);
    /// Appends the remaining samples.
    Result<void> finish(std::vector<double>& out);
    /// Applies the filters that run after resampling, and updates the statistics of the final force.
    void complete(std::span<double> force);

private:
    ChannelPath(const RecordingOptions&, double gain, bool filter_early, const HumTable&);
    void append(std::vector<double>& out);
};

}  // namespace corpuscle
