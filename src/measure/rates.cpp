#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/measures.hpp"

namespace corpuscle {
namespace {
constexpr double none = std::numeric_limits<double>::quiet_NaN();
}

Stretch::Stretch(std::span<const double> t, const Phase& p) : train(t), phase(p) {
    begin = static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), p.from) - t.begin());
    end = std::max(begin, static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), p.to) - t.begin()));
}

double spike_count(const Stretch& s) { return static_cast<double>(s.count()); }

double mean_rate(const Stretch& s) { return s.phase.to > s.phase.from ? spike_count(s) / (s.phase.to - s.phase.from) : none; }

double peak_rate(const Stretch& s) {
    double peak = none;
    for (std::size_t k = s.begin; k < s.end && k + 1 < s.train.size(); ++k)
        if (s.rate_at(k) > peak || std::isnan(peak)) peak = s.rate_at(k);
    return peak;
}

double first_rate(const Stretch& s) { return s.begin < s.end && s.begin + 1 < s.train.size() ? s.rate_at(s.begin) : none; }

double last_rate(const Stretch& s) { return s.count() >= 2 ? s.rate_at(s.end - 2) : none; }

std::vector<double> instantaneous_rates(std::span<const double> train) {
    std::vector<double> rates;
    const Stretch whole(train, {"", -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()});
    for (std::size_t k = 0; k + 1 < train.size(); ++k) rates.push_back(whole.rate_at(k));
    return rates;
}

}  // namespace corpuscle
