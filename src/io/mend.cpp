#include "io/mend.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace corpuscle {

/// The sample at center_, or NaN if it is an outlier.
double StrayFilter::judged() {
    const double x = last_[centre_], median = sorted_.empty() ? x : sorted_[sorted_.size() / 2], off = std::abs(x - median);
    if (!(off > 0)) return x;
    double limit = limit_.value_or(0);
    if (!limit_) {
        std::vector<double> deviations;
        for (const double y : sorted_) deviations.push_back(std::abs(y - median));
        const auto middle = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() / 2);
        std::nth_element(deviations.begin(), middle, deviations.end());
        limit = 6 * 1.4826 * *middle;  // 1.4826: ratio of the standard deviation to the median absolute deviation of a normal distribution
    }
    if (off <= limit) return x;
    ++found;
    return std::numeric_limits<double>::quiet_NaN();
}

void StrayFilter::push(double x, std::vector<double>& out) {
    if (last_.size() == window) {
        if (const double oldest = last_.front(); !std::isnan(oldest))
            sorted_.erase(std::lower_bound(sorted_.begin(), sorted_.end(), oldest));
        last_.erase(last_.begin());
    }
    last_.push_back(x);
    if (!std::isnan(x)) sorted_.insert(std::upper_bound(sorted_.begin(), sorted_.end(), x), x);
    if (last_.size() <= half) return;
    centre_ = last_.size() - 1 - half;
    out.push_back(judged());
}

void StrayFilter::finish(std::vector<double>& out) {
    for (centre_ = last_.size() > half ? last_.size() - half : 0; centre_ < last_.size(); ++centre_) out.push_back(judged());
}

Result<void> GapFiller::push(double x, std::vector<double>& out) {
    if (std::isnan(x)) {
        if (++missing_ > longest) return bad_input(fmt::format("{} consecutive samples are missing or bad", missing_));
        return {};
    }
    const double from = std::isnan(before_) ? x : before_;
    const auto steps = static_cast<double>(missing_ + 1);
    for (std::int64_t k = 1; k <= missing_; ++k) out.push_back(from + (x - from) * (static_cast<double>(k) / steps));
    filled += missing_;
    missing_ = 0;
    out.push_back(before_ = x);
    return {};
}

Result<void> GapFiller::push(std::span<const double> x, std::vector<double>& out) {
    for (std::size_t k = 0; k < x.size();) {
        std::size_t good = k;
        while (missing_ == 0 && good < x.size() && !std::isnan(x[good])) ++good;
        out.insert(out.end(), x.begin() + static_cast<std::ptrdiff_t>(k), x.begin() + static_cast<std::ptrdiff_t>(good));
        if (good > k) before_ = x[good - 1];
        if ((k = good) < x.size())
            if (auto ok = push(x[k++], out); !ok) return ok;
    }
    return {};
}

Result<void> GapFiller::finish(std::vector<double>& out) {
    if (missing_ > 0 && std::isnan(before_)) return bad_input("all samples are missing or bad");
    out.insert(out.end(), static_cast<std::size_t>(missing_), before_);
    filled += missing_;
    missing_ = 0;
    return {};
}

}  // namespace corpuscle
