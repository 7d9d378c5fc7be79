#include "circuit/afferent/force_waveform.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace corpuscle::circuit {
namespace {

constexpr double min_bend = 2e-3;       // smallest bend of a breakpoint, as a fraction of the largest force
constexpr double min_bend_ratio = 4;    // smallest ratio of its bend to the smaller of the bends two samples before and after
constexpr double max_deviation = 0.05;  // from the line from the last breakpoint, as a fraction of the largest force

/// Limits a number of samples to the range in which a double represents every integer; a damaged state may contain larger ones.
double to_exact_range(double samples) { return samples >= -0x1p53 && samples <= 0x1p53 ? samples : samples > 0 ? 0x1p53 : -0x1p53; }

}  // namespace

double ForceWaveform::sample(std::int64_t k) const {
    if (samples_.empty()) return 0;
    return samples_[static_cast<std::size_t>(std::clamp<std::int64_t>(k - first_, 0, static_cast<std::int64_t>(samples_.size()) - 1))];
}

void ForceWaveform::append(std::span<const double> force) {
    samples_.insert(samples_.end(), force.begin(), force.end());
    while (next_to_check_ + lookahead < first_ + static_cast<std::int64_t>(samples_.size())) check_next_sample();
}

/// Adds the next sample to the breakpoints if it is one.
void ForceWaveform::check_next_sample() {
    const std::int64_t k = next_to_check_++;
    const auto begin_line = [&](std::int64_t from) {
        line_from_ = static_cast<double>(from), line_at_ = sample(from), line_slope_ = sample(from + 1) - sample(from);
    };
    largest_ = std::max({largest_, std::abs(sample(k - 1)), std::abs(sample(k)), std::abs(sample(k + lookahead))});
    if (k == 1) begin_line(0);  // before the first breakpoint
    const double nearby_bend = std::min(std::abs(bend(k - 2)), std::abs(bend(k + 2)));
    const bool is_sharp = std::abs(bend(k)) > std::max(min_bend * largest_, min_bend_ratio * nearby_bend);
    const double line = line_at_ + line_slope_ * (static_cast<double>(k) - line_from_);
    if (!is_sharp && std::abs(sample(k) - line) <= max_deviation * largest_) return;
    breakpoints_.push_back(k);
    begin_line(k);
}

double ForceWaveform::at(double t) const {
    const double position = to_exact_range(t / T_), before = std::floor(position);
    const auto k = static_cast<std::int64_t>(before);
    const double a = sample(k);
    return a + (position - before) * (sample(k + 1) - a);
}

double ForceWaveform::next_breakpoint(double t) const {
    const auto after = std::upper_bound(breakpoints_.begin(), breakpoints_.end(), t,
                                        [&](double time, std::int64_t k) { return time < static_cast<double>(k) * T_; });
    return after == breakpoints_.end() ? std::numeric_limits<double>::infinity() : static_cast<double>(*after) * T_;
}

void ForceWaveform::discard_before(double t) {
    const auto from = std::min(static_cast<std::int64_t>(std::floor(to_exact_range(t / T_))) - 1, next_to_check_ - lookahead);
    if (from <= first_) return;
    const auto count = std::min<std::int64_t>(from - first_, static_cast<std::int64_t>(samples_.size()));
    samples_.erase(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(count));
    first_ += count;
    breakpoints_.erase(breakpoints_.begin(), std::lower_bound(breakpoints_.begin(), breakpoints_.end(), from));
}

void ForceWaveform::shift_origin(std::int64_t samples) {
    first_ -= samples, next_to_check_ -= samples, line_from_ -= static_cast<double>(samples);
    for (auto& k : breakpoints_) k -= samples;
}

void ForceWaveform::archive(StateArchive& a) {
    auto breakpoints = breakpoints_.size();
    for (auto* n : {&first_, &next_to_check_}) a.integer(*n, -max_exact_integer, max_exact_integer);
    a.integer(breakpoints, 0, a.is_reader() ? static_cast<double>(a.rest()) : max_exact_integer);
    for (double* x : {&line_from_, &line_at_, &line_slope_, &largest_}) a.number(*x);
    breakpoints_.resize(breakpoints);
    for (auto& k : breakpoints_) a.integer(k, -max_exact_integer, max_exact_integer);
    a.numbers(samples_, a.is_reader() ? a.rest() : samples_.size());
}

}  // namespace corpuscle::circuit
