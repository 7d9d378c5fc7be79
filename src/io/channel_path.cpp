#include "io/channel_path.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace corpuscle {

void Levels::add(std::span<const double> force) {
    double low = least, high = greatest;  // local variables, which stay in registers
    std::int64_t below_count = 0, above_count = 0, negative_count = 0;
    for (const double F : force) {
        low = F < low ? F : low, high = F > high ? F : high;
        below_count += F < 0.2, above_count += F > 4, negative_count += F < 0;
    }
    least = low, greatest = high, below += below_count, above += above_count, negative += negative_count;
    count += static_cast<std::int64_t>(force.size());
}

ChannelPath::ChannelPath(const RecordingOptions& options, double gain, bool filter_early, const HumTable& table)
    : offset_(options.offset), gain_(gain), filter_early_(filter_early), hum(table) {
    if (options.despike) strays_.emplace(*options.despike);
}

Result<ChannelPath> ChannelPath::make(const RecordingOptions& options, double gain, const Clock& filters, bool filter_early,
                                      const HumTable& table) {
    ChannelPath path(options, gain, filter_early, table);
    for (const double f : options.notch) {
        const auto filter = Biquad::notch(f, filters);
        if (!filter) return filter.error();
        path.filters_.push_back(*filter);
    }
    if (options.lowpass) {
        const auto filter = Biquad::lowpass(*options.lowpass, filters);
        if (!filter) return filter.error();
        path.filters_.push_back(*filter);
    }
    return path;
}

Result<void> ChannelPath::mend(std::span<const double> read) {
    if (strays_) {
        judged_.clear();
        for (const double x : read) strays_->push(x, judged_);
        read = judged_;
    }
    return gaps_.push(read, mended_);
}

/// Converts the repaired samples to newtons and appends them. The detectors see them before the filters, which would hide faults.
void ChannelPath::append(std::vector<double>& out) {
    for (double& x : mended_) x = gain_ * (x - offset_);
    stray_check.add(mended_);
    saturation.add(mended_);
    if (filter_early_)
        for (auto& filter : filters_)
            for (double& x : mended_) x = filter.next(x);
    out.insert(out.end(), mended_.begin(), mended_.end());
    mended_.clear();
}

Result<void> ChannelPath::push(std::span<const double> read, std::vector<double>& out) {
    if (auto ok = mend(read); !ok) return ok;
    append(out);
    return {};
}

Result<void> ChannelPath::finish(std::vector<double>& out) {
    judged_.clear();
    if (strays_) strays_->finish(judged_);
    if (auto ok = gaps_.push(judged_, mended_); !ok) return ok;
    if (auto ok = gaps_.finish(mended_); !ok) return ok;
    append(out);
    return {};
}

void ChannelPath::complete(std::span<double> force) {
    if (!filter_early_)
        for (auto& filter : filters_)
            for (double& x : force) x = filter.next(x);
    hum.add(force);
    levels.add(force);
}

}  // namespace corpuscle
