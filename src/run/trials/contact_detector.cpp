#include "run/trials/contact_detector.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/median.hpp"

namespace corpuscle {
namespace {

/// The quantile q of values, which are reordered: the value with the rank nearest to q of the way from the lowest to the highest.
double quantile(std::vector<double>& values, double q) {
    const auto rank = static_cast<std::ptrdiff_t>(std::lround(q * static_cast<double>(values.size() - 1)));
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[static_cast<std::size_t>(rank)];
}

/// Sets level, noise and thresholds.
void measure_rest(std::span<const double> force, std::optional<double> threshold, Contacts& out) {
    std::vector<double> values(force.begin(), force.end());
    const double low = quantile(values, 0.01), high = quantile(values, 0.99);
    std::erase_if(values, [limit = low + (high - low) / 4](double f) { return f > limit; });
    out.level = median_of(values);
    for (double& f : values) f = std::abs(f - out.level);
    out.noise = median_of(values) / 0.6745;
    out.threshold =
        threshold.value_or(out.level + std::max(max_noise_of_rest * out.noise, min_rise_of_contact * std::max(high - out.level, 0.0)));
    out.release = out.threshold > out.level ? out.level + (out.threshold - out.level) / 2 : out.threshold;
}

}  // namespace

std::vector<double> Contacts::onsets() const {
    std::vector<double> out;
    for (const auto& c : contacts) out.push_back(c.onset);
    return out;
}

Contacts find_contacts(std::span<const double> force, const Clock& clock, std::optional<double> threshold) {
    Contacts out;
    if (force.empty()) return out;
    measure_rest(force, threshold, out);
    constexpr double open = std::numeric_limits<double>::infinity();
    bool is_touching = force[0] > out.release;
    auto& all = out.contacts;
    if (is_touching) all.push_back({std::numeric_limits<double>::quiet_NaN(), open});  // has no onset
    for (std::size_t k = 1; k < force.size(); ++k) {
        if (is_touching && force[k] < out.release) {
            is_touching = false;
            all.back().release = clock.time(static_cast<std::int64_t>(k));
        } else if (!is_touching && force[k] > out.threshold) {
            is_touching = true;
            const double part = force[k - 1] < out.threshold ? (out.threshold - force[k - 1]) / (force[k] - force[k - 1]) : 1;
            const double onset = clock.time(static_cast<std::int64_t>(k), part);
            if (!all.empty() && onset - all.back().release < min_pause)
                all.back().release = open;
            else
                all.push_back({onset, open});
        }
    }
    std::erase_if(all, [](const ContactInterval& c) { return std::isnan(c.onset) || c.release - c.onset < min_contact; });
    return out;
}

}  // namespace corpuscle
