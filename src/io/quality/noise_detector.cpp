#include "io/quality/noise_detector.hpp"

#include <cmath>

namespace corpuscle {

void NoiseDetector::end_chunk() {
    // For white noise of standard deviation s the third difference has sqrt(20) s, and the mean of its absolute value is sqrt(2 / pi) of
    // that.
    constexpr double third_per_deviation = 3.5682482323055424, min_ratio = 2.3;
    if (third_ > 0 && third_ >= min_ratio * first_) deviations_.add(third_ / static_cast<double>(chunk) / third_per_deviation);
    ++chunks_, first_ = third_ = 0;
}

void NoiseDetector::add(std::span<const double> samples) {
    for (const double x : samples) {
        const double d = x - x_1_, dd = d - d_1_;
        if (seen_ >= 3) {
            first_ += std::abs(d), third_ += std::abs(dd - dd_1_);
            if ((seen_ - 2) % chunk == 0) end_chunk();
        }
        x_1_ = x, d_1_ = d, dd_1_ = dd, ++seen_;
    }
}

double NoiseDetector::deviation() const {
    constexpr std::int64_t min_chunks = 4;  // a shorter recording does not tell noise from force
    if (chunks_ < min_chunks || deviations_.count() * 10 < chunks_) return 0;
    return deviations_.quantile(0.5);
}

}  // namespace corpuscle
