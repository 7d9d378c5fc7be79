#include "run/sinks/time_bins.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/text/quantity.hpp"

namespace corpuscle {

Result<void> TimeBins::check(const Clock& clock, double bin_width) {
    const double min = 0.01 * clock.T();
    if (bin_width >= min * (1 - 1e-9)) return {};
    return bad_usage(fmt::format("--bin {}: shorter than a hundredth of the {} between samples; write {} or more",
                                 format_quantity(bin_width, "s"), format_quantity(clock.T(), "s"), format_quantity(min, "s")));
}

TimeBins::TimeBins(std::vector<Group> groups, const Clock& clock, double bin_width)
    : groups_(std::move(groups)), since_start_(clock), bin_width_(bin_width), t0_(std::exchange(since_start_.t0, 0.0)),
      counts_(groups_.size()) {}

std::int64_t TimeBins::bin_index(double t) const { return static_cast<std::int64_t>(std::floor(t / bin_width_ + 1e-9)); }

/// Completes the current bin, which ends at `to` (s since the start).
void TimeBins::end_bin(double to) {
    if (std::exchange(lines_taken_, false)) text_.clear();
    const double from = static_cast<double>(current_bin_) * bin_width_;
    for (std::size_t g = 0; g < counts_.size(); ++g)
        fmt::format_to(std::back_inserter(text_), "{},{:.9f},{:.9f},{},{:.6g}\n", groups_[g].names, t0_ + from, t0_ + to, counts_[g],
                       static_cast<double>(counts_[g]) / (to - from) / groups_[g].afferents);
    counts_.assign(counts_.size(), 0);
    ++current_bin_;
}

void TimeBins::end_bins_before(std::int64_t bin) {
    while (current_bin_ < bin) end_bin(static_cast<double>(current_bin_ + 1) * bin_width_);
}

void TimeBins::count(const Spike& s, std::size_t group) {
    end_bins_before(bin_index(since_start_.time(s.step, s.offset)));
    ++counts_[group];
}

void TimeBins::advance_to(std::int64_t sample) { end_bins_before(bin_index(since_start_.time(sample))); }

void TimeBins::end(std::int64_t samples) {
    const double end = since_start_.time(samples);
    end_bins_before(std::max<std::int64_t>(static_cast<std::int64_t>(std::ceil(end / bin_width_ - 1e-9)) - 1, 0));
    end_bin(end);
}

std::string_view TimeBins::take_lines() {
    if (std::exchange(lines_taken_, true)) text_.clear();
    return {text_.data(), text_.size()};
}

}  // namespace corpuscle
