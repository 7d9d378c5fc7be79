#include "circuit/solve/history.hpp"

namespace corpuscle::circuit {

void History::accept() {
    first_ = (first_ + capacity - 1) % capacity;
    count_ = std::min(count_ + 1, max_points), smooth_count_ = std::min(smooth_count_ + 1, max_points);
}

HistoryWeights weights_of_value(std::span<const double> times, double t) {
    HistoryWeights w{};
    for (std::size_t j = 0; j < times.size(); ++j) {
        double factor = 1;
        for (std::size_t i = 0; i < times.size(); ++i)
            if (i != j) factor *= (t - times[i]) / (times[j] - times[i]);
        w[j] = factor;
    }
    return w;
}

HistoryWeights weights_of_slope(std::span<const double> times, double t, double& leading) {
    HistoryWeights w{};
    leading = 0;
    for (std::size_t j = 0; j < times.size(); ++j) {
        leading += 1 / (t - times[j]);
        double factor = 1 / (times[j] - t);
        for (std::size_t i = 0; i < times.size(); ++i)
            if (i != j) factor *= (t - times[i]) / (times[j] - times[i]);
        w[j] = factor;
    }
    return w;
}

HistoryWeights weights_of_interpolation_error(std::span<const double> times) {
    HistoryWeights w{};
    const double half = times[1] + (times[0] - times[1]) / 2;
    double numerator = 1;  // the product of (half - time) over all points but the last
    for (std::size_t j = 0; j + 1 < times.size(); ++j) numerator *= half - times[j];
    for (std::size_t k = 0; k < times.size(); ++k) {
        double denominator = 1;
        for (std::size_t j = 0; j < times.size(); ++j)
            if (j != k) denominator *= times[k] - times[j];
        w[k] = numerator / denominator;
    }
    return w;
}

std::array<double, History::max_points> History::times() const {
    std::array<double, max_points> out{};
    for (int k = 0; k < smooth_count_; ++k) out[static_cast<std::size_t>(k)] = (*this)[k].t;
    return out;
}

History::Weights History::value_weights(double t, int points) const {
    const auto all = times();
    return weights_of_value(std::span(all).first(static_cast<std::size_t>(points)), t);
}

History::Weights History::slope_weights(double t, int order, double& leading) const {
    const auto all = times();
    return weights_of_slope(std::span(all).first(static_cast<std::size_t>(order)), t, leading);
}

namespace {

/// Sums in the order of the points, in one pass.
template <std::size_t points>
void add_weighted(const double* const* from, const double* w, std::span<double> out) {
    std::array<const double*, points> x;
    std::array<double, points> weight;
    std::copy_n(from, points, x.begin()), std::copy_n(w, points, weight.begin());
    for (std::size_t n = 0; n < out.size(); ++n) {
        double sum = weight[0] * x[0][n];
        for (std::size_t j = 1; j < points; ++j) sum += weight[j] * x[j][n];
        out[n] = sum;
    }
}

}  // namespace

void History::combine(const Weights& w, int points, std::vector<double> TimePoint::* member, std::span<double> out) const {
    using Sum = void (*)(const double* const*, const double*, std::span<double>);
    constexpr Sum sums[max_points] = {&add_weighted<1>, &add_weighted<2>, &add_weighted<3>, &add_weighted<4>,
                                      &add_weighted<5>, &add_weighted<6>, &add_weighted<7>};
    std::array<const double*, max_points> from{};
    for (int j = 0; j < points; ++j) from[static_cast<std::size_t>(j)] = ((*this)[j].*member).data();
    if (points > 0) sums[points - 1](from.data(), w.data(), out);
}

}  // namespace corpuscle::circuit
