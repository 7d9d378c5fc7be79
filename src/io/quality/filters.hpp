#pragma once
// Filters of a recording's channel: repair (HampelFilter removes isolated outliers, GapFiller fills missing samples, NaN, by linear
// interpolation), and causal filters (Biquad, RestLevel, Deadband). The result for a sample of the repair depends only on that sample and
// its neighbours, not on the size of the blocks that are read. The output of a causal filter depends only on the current and earlier
// samples, so a stream and a file give the same result.
//
// In the repair, push() adds samples and appends finished ones to `out`, after a delay. finish() appends the last ones at the end of the
// file.

#include <limits>
#include <span>
#include <vector>

#include "core/clock.hpp"
#include "io/quality/deadband.hpp"

namespace corpuscle {

/// The argument of --despike: the largest distance of a sample from the median of the samples around it that is not an outlier.
struct DespikeOptions {
    /// In the unit of the values in the file. Default: 6 standard deviations, estimated from the median absolute deviation of these
    /// samples.
    std::optional<double> limit = {};
};

/// A Hampel filter: a sample whose distance from the median of the 25 samples around it (itself included) exceeds the limit becomes missing
/// (NaN). The output is delayed by 12 samples.
class HampelFilter {
    static constexpr std::size_t half_window = 12, window = 2 * half_window + 1;
    std::optional<double> limit_;
    std::vector<double> last_;    // the latest samples, at most `window`, oldest first
    std::vector<double> sorted_;  // those of them that are not missing, in ascending order
    std::size_t center_ = 0;      // index in last_ of the next sample to be filtered

    double filtered();

public:
    explicit HampelFilter(const DespikeOptions& despike) : limit_(despike.limit) {}
    void push(double x, std::vector<double>& out);
    void finish(std::vector<double>& out);
    std::int64_t outliers = 0;  ///< number of samples removed so far
};

/// Replaces missing samples (NaN) by linear interpolation. Missing samples at the beginning or the end of the recording are replaced by the
/// first or the last sample that is not missing. More than max_gap consecutive missing samples are an error.
class GapFiller {
    static constexpr std::int64_t max_gap = 1'000'000;             // samples
    double last_good_ = std::numeric_limits<double>::quiet_NaN();  // the latest sample that is not missing; NaN: none so far
    std::int64_t missing_ = 0;                                     // number of missing samples after it

    Result<void> push(double x, std::vector<double>& out);

public:
    Result<void> push(std::span<const double> x, std::vector<double>& out);
    Result<void> finish(std::vector<double>& out);
    std::int64_t filled = 0;  ///< number of samples replaced so far
};

/// A second-order section, y[k] = b0 x[k] + b1 x[k-1] + b2 x[k-2] - a1 y[k-1] - a2 y[k-2], in transposed direct form II. It begins in the
/// steady state of a constant input equal to the first sample.
class Biquad {
    double b0_, b1_, b2_, a1_, a2_;
    double s1_ = 0, s2_ = 0;   // state
    bool is_started_ = false;  // true after the first sample

    Biquad(double b0, double b1, double b2, double a0, double a1, double a2)
        : b0_(b0 / a0), b1_(b1 / a0), b2_(b2 / a0), a1_(a1 / a0), a2_(a2 / a0) {}

public:
    // A frequency f that is not between 0 and half the sample rate is an error.

    /// A filter that removes the frequency f (Hz). The -3 dB points are at f +- 2 Hz, or at f +- f/4 if f is below 8 Hz.
    static Result<Biquad> notch(double f, const Clock&);
    /// A second-order Butterworth low-pass filter, -3 dB at f (Hz).
    static Result<Biquad> lowpass(double f, const Clock&);

    /// The output for the next sample x.
    double next(double x) {
        if (!is_started_) {  // steady state for x: y = x, because both filters have unit gain at 0 Hz
            is_started_ = true;
            s2_ = (b2_ - a2_) * x;
            s1_ = (b1_ - a1_) * x + s2_;
        }
        const double y = b0_ * x + s1_;
        s1_ = flush_tiny(b1_ * x - a1_ * y + s2_);
        s2_ = flush_tiny(b2_ * x - a2_ * y);
        return y;
    }

private:
    /// Flushes tiny values to zero. Otherwise the states would become denormal long after a touch, which is slow.
    static double flush_tiny(double s) { return s > -1e-200 && s < 1e-200 ? 0 : s; }
};

/// Subtracts the level of a sensor at rest: the median of the first samples, during which the output is 0. A RestLevel without a rest
/// period changes nothing.
class RestLevel {
    std::vector<double> first_ = {};  // the samples of the rest period; `seen_` of them are known
    std::size_t seen_ = 0;
    double level_ = 0, noise_ = 0;  // valid after the rest period

public:
    static constexpr std::size_t min_noise_samples = 20;  ///< a shorter rest period does not measure the noise
    RestLevel() = default;
    /// `seconds`: length of the rest period, at least one sample.
    static Result<RestLevel> make(double seconds, const Clock&);
    double next(double x);
    bool is_used() const { return !first_.empty(); }
    bool is_known() const { return seen_ == first_.size(); }  ///< true after the rest period
    double level() const { return level_; }                   ///< valid if is_known()
    double noise() const { return noise_; }                   ///< standard deviation in the rest period, N; valid if is_known()
    std::size_t samples() const { return first_.size(); }     ///< number of samples of the rest period
};

/// The causal filters of one channel, in the order in which they apply.
struct ChannelFilters {
    std::vector<Biquad> biquads = {};
    RestLevel rest = {};
    Deadband deadband = {};
    bool measures_deadband = false;  ///< true: the band follows from the noise in the rest period

    bool empty() const { return biquads.empty() && !rest.is_used() && !deadband.is_used(); }
    /// The deadband of --deadband, after `rest` has been set. A band that cannot be measured is an error.
    Result<void> add_deadband(const DeadbandOptions&, const Clock&);
    double next(double x) { return hold(smooth(x)); }
    // The two parts of next(): the linear filters, then the rest level and the deadband.
    double smooth(double x) {
        for (auto& b : biquads) x = b.next(x);
        return x;
    }
    double hold(double x) {
        x = rest.next(x);
        if (measures_deadband && !deadband.is_used() && rest.is_known()) deadband.set_band(Deadband::max_noise * rest.noise());
        return deadband.next(x);
    }
};

}  // namespace corpuscle
