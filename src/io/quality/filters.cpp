#include "io/quality/filters.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/median.hpp"
#include "core/number/elementary.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

/// Returns an error if f is not between 0 and half the sample rate. `option` is the option that gives f, for the message.
Result<void> check_frequency(double f, const Clock& clock, const char* option) {
    if (f > 0 && f < clock.rate() / 2) return {};
    return bad_input(
        fmt::format("{} {:g}Hz: at a sample rate of {:g} Hz it must be between 0 and {:g} Hz", option, f, clock.rate(), clock.rate() / 2));
}

}  // namespace

/// The sample last_[center_], or NaN if it is an outlier.
double HampelFilter::filtered() {
    const double x = last_[center_], median = sorted_.empty() ? x : sorted_[sorted_.size() / 2], deviation = std::abs(x - median);
    if (!(deviation > 0)) return x;  // also for a missing sample, whose deviation is NaN
    double limit = limit_.value_or(0);
    if (!limit_) {
        std::vector<double> deviations;
        for (const double y : sorted_) deviations.push_back(std::abs(y - median));
        const auto middle = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() / 2);
        std::nth_element(deviations.begin(), middle, deviations.end());
        limit = 6 * 1.4826 * *middle;  // 1.4826: ratio of the standard deviation to the median absolute deviation of a normal distribution
    }
    if (deviation <= limit) return x;
    ++outliers;
    return std::numeric_limits<double>::quiet_NaN();
}

void HampelFilter::push(double x, std::vector<double>& out) {
    if (last_.size() == window) {
        if (const double oldest = last_.front(); !std::isnan(oldest))
            sorted_.erase(std::lower_bound(sorted_.begin(), sorted_.end(), oldest));
        last_.erase(last_.begin());
    }
    last_.push_back(x);
    if (!std::isnan(x)) sorted_.insert(std::upper_bound(sorted_.begin(), sorted_.end(), x), x);
    if (last_.size() <= half_window) return;
    center_ = last_.size() - 1 - half_window;
    out.push_back(filtered());
}

void HampelFilter::finish(std::vector<double>& out) {
    // push() has filtered the samples before these.
    for (center_ = last_.size() > half_window ? last_.size() - half_window : 0; center_ < last_.size(); ++center_)
        out.push_back(filtered());
}

Result<void> GapFiller::push(double x, std::vector<double>& out) {
    if (std::isnan(x)) {
        if (++missing_ > max_gap) return bad_input(fmt::format("{} consecutive samples are missing or bad", missing_));
        return {};
    }
    const double from = std::isnan(last_good_) ? x : last_good_;
    const auto steps = static_cast<double>(missing_ + 1);
    for (std::int64_t k = 1; k <= missing_; ++k) out.push_back(from + (x - from) * (static_cast<double>(k) / steps));
    filled += missing_;
    missing_ = 0;
    out.push_back(last_good_ = x);
    return {};
}

Result<void> GapFiller::push(std::span<const double> x, std::vector<double>& out) {
    for (std::size_t k = 0; k < x.size();) {
        std::size_t good = k;
        while (missing_ == 0 && good < x.size() && !std::isnan(x[good])) ++good;
        out.insert(out.end(), x.begin() + static_cast<std::ptrdiff_t>(k), x.begin() + static_cast<std::ptrdiff_t>(good));
        if (good > k) last_good_ = x[good - 1];
        if ((k = good) < x.size()) TRY(push(x[k++], out));
    }
    return {};
}

Result<void> GapFiller::finish(std::vector<double>& out) {
    if (missing_ > 0 && std::isnan(last_good_)) return bad_input("all samples are missing or bad");
    out.insert(out.end(), static_cast<std::size_t>(missing_), last_good_);
    filled += missing_;
    missing_ = 0;
    return {};
}

// Both filters use the bilinear transform, prewarped so that f is exact. Source: R. Bristow-Johnson, "Cookbook formulae for audio EQ
// biquad filter coefficients". With the angular frequency w = 2 pi f / rate: alpha = sin(w) / (2 Q), c = -2 cos(w) for the notch, and
// c = cos(w) for the low-pass filter.

Result<Biquad> Biquad::notch(double f, const Clock& clock) {
    TRY(check_frequency(f, clock, "--notch"));
    const double turns = f / clock.rate(), Q = f / std::min(4.0, f / 2);  // Q: f over the -3 dB bandwidth
    const double alpha = num::sin_turns(turns) / (2 * Q), c = -2 * num::cos_turns(turns);
    return Biquad(1, c, 1, 1 + alpha, c, 1 - alpha);
}

Result<Biquad> Biquad::lowpass(double f, const Clock& clock) {
    TRY(check_frequency(f, clock, "--lowpass"));
    const double turns = f / clock.rate(), c = num::cos_turns(turns), alpha = num::sin_turns(turns) * 0.70710678118654752;  // Q = sqrt(1/2)
    return Biquad((1 - c) / 2, 1 - c, (1 - c) / 2, 1 + alpha, -2 * c, 1 - alpha);
}

Result<RestLevel> RestLevel::make(double seconds, const Clock& clock) {
    constexpr double max_samples = 1 << 24;
    const double samples = std::round(seconds * clock.rate());
    if (!(samples >= 1 && samples <= max_samples))
        return bad_input(fmt::format("--zero {:g}s: at {:g} Hz the rest period must be between {:.3g} and {:.3g} s", seconds, clock.rate(),
                                     clock.T(), max_samples * clock.T()));
    RestLevel out;
    out.first_.resize(static_cast<std::size_t>(samples));
    return out;
}

double RestLevel::next(double x) {
    if (is_known()) return x - level_;
    first_[seen_++] = x;
    if (is_known()) level_ = median_of(first_), noise_ = noise_deviation(first_, level_);
    return 0;
}

Result<void> ChannelFilters::add_deadband(const DeadbandOptions& options, const Clock& clock) {
    if (options.band) return deadband = Deadband(*options.band), Result<void>();
    measures_deadband = true;
    const auto enough = fmt::format("{:.4g}s", RestLevel::min_noise_samples * clock.T());
    if (!rest.is_used())
        return bad_usage(
            fmt::format("--deadband auto measures the noise while nothing touches the sensor; add such a time at the "
                        "beginning, at least --zero {}, or give the band: --deadband 20mN",
                        enough));
    if (rest.samples() >= RestLevel::min_noise_samples) return {};
    return bad_usage(fmt::format("--deadband auto: a rest period of {} samples is too short to measure the noise; use --zero {} or more",
                                 rest.samples(), enough));
}

}  // namespace corpuscle
