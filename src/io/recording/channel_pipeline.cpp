#include "io/recording/channel_pipeline.hpp"

#include <fmt/format.h>
#include <cmath>

namespace corpuscle {

void ForceLevels::add(std::span<const double> force) {
    double low = min, high = max;  // local variables stay in registers, members would not
    std::int64_t below_count = 0, above_count = 0, negative_count = 0;
    for (const double F : force) {
        low = F < low ? F : low, high = F > high ? F : high;
        below_count += F < 0.2, above_count += F > 4, negative_count += F < 0;
    }
    min = low, max = high, below_range += below_count, above_range += above_count, negative += negative_count;
    count += static_cast<std::int64_t>(force.size());
}

ChannelPipeline::ChannelPipeline(const RecordingOptions& options, double gain, bool filters_rows, const HumTable& table)
    : offset_(options.offset), gain_(gain), filters_rows_(filters_rows), hum(table) {
    if (options.despike) outlier_filter_.emplace(*options.despike);
}

Result<ChannelPipeline> ChannelPipeline::make(const RecordingOptions& options, double gain, const Clock& filter_clock, bool filters_rows,
                                              const HumTable& table) {
    ChannelPipeline pipeline(options, gain, filters_rows, table);
    for (const double f : options.notch) pipeline.filters_.push_back(TRY(Biquad::notch(f, filter_clock)));
    if (options.lowpass) pipeline.filters_.push_back(TRY(Biquad::lowpass(*options.lowpass, filter_clock)));
    return pipeline;
}

Result<void> ChannelPipeline::repair(std::span<const double> values) {
    if (outlier_filter_) {
        despiked_.clear();
        for (const double x : values) outlier_filter_->push(x, despiked_);
        values = despiked_;
    }
    return gaps_.push(values, repaired_);
}

/// Converts the repaired samples to newtons and appends them to `out`. The detectors examine the samples before they are filtered, because
/// the filters hide faults.
void ChannelPipeline::append(std::vector<double>& out) {
    for (double& x : repaired_) x = gain_ * (x - offset_);
    outliers.add(repaired_);
    saturation.add(repaired_);
    if (filters_rows_)
        for (auto& filter : filters_)
            for (double& x : repaired_) x = filter.next(x);
    out.insert(out.end(), repaired_.begin(), repaired_.end());
    repaired_.clear();
}

Result<void> ChannelPipeline::push(std::span<const double> values, std::vector<double>& out) {
    TRY(repair(values));
    append(out);
    return {};
}

Result<void> ChannelPipeline::finish(std::vector<double>& out) {
    despiked_.clear();
    if (outlier_filter_) outlier_filter_->finish(despiked_);
    TRY(gaps_.push(despiked_, repaired_));
    TRY(gaps_.finish(repaired_));
    append(out);
    return {};
}

void ChannelPipeline::finish_force(std::span<double> force) {
    if (!filters_rows_)
        for (auto& filter : filters_)
            for (double& x : force) x = filter.next(x);
    hum.add(force);
    levels.add(force);
}

}  // namespace corpuscle
