#include "study/bins.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "signal/quantity.hpp"

namespace corpuscle {

Result<void> EvenBins::check(const Clock& clock, double bin) {
    const double min = 0.01 * clock.T();
    if (bin >= min * (1 - 1e-9)) return {};
    return bad_usage(fmt::format("--bin {}: shorter than a hundredth of the {} between samples; write {} or more",
                                 format_quantity(bin, "s"), format_quantity(clock.T(), "s"), format_quantity(min, "s")));
}

EvenBins::EvenBins(std::vector<Row> rows, const Clock& clock, double bin)
    : rows_(std::move(rows)), since_start_(clock), bin_(bin), t0_(std::exchange(since_start_.t0, 0.0)), now_(rows_.size()) {}

std::int64_t EvenBins::bin_of(double t) const { return static_cast<std::int64_t>(std::floor(t / bin_ + 1e-9)); }

/// Completes the current bin, which ends at `to` (s since the start).
void EvenBins::put(double to) {
    if (std::exchange(told_, false)) text_.clear();
    const double from = static_cast<double>(at_) * bin_;
    for (std::size_t r = 0; r < now_.size(); ++r)
        fmt::format_to(std::back_inserter(text_), "{},{:.9f},{:.9f},{},{:.6g}\n", rows_[r].name, t0_ + from, t0_ + to, now_[r],
                       static_cast<double>(now_[r]) / (to - from) / rows_[r].units);
    now_.assign(now_.size(), 0);
    ++at_;
}

void EvenBins::fill_up_to(std::int64_t bin) {
    while (at_ < bin) put(static_cast<double>(at_ + 1) * bin_);
}

void EvenBins::count(const Spike& s, std::size_t row) {
    fill_up_to(bin_of(since_start_.time(s.step, s.offset)));
    ++now_[row];
}

void EvenBins::known_to(std::int64_t sample) { fill_up_to(bin_of(since_start_.time(sample))); }

void EvenBins::end(std::int64_t samples) {
    const double end = since_start_.time(samples);
    fill_up_to(std::max<std::int64_t>(static_cast<std::int64_t>(std::ceil(end / bin_ - 1e-9)) - 1, 0));
    put(end);
}

std::string_view EvenBins::lines() {
    if (std::exchange(told_, true)) text_.clear();
    return {text_.data(), text_.size()};
}

}  // namespace corpuscle
