#include "measure/measures.hpp"

#include <cmath>

namespace corpuscle {
namespace {

/// Calls f with each measure.
template <class Tuple, class F>
void each(Tuple& all, F&& f) {
    std::apply([&](auto&... m) { (f(m), ...); }, all);
}

}  // namespace

Tally::Tally(std::vector<Stretch> stretches, std::size_t trains)
    : stretches_(std::move(stretches)), trains_(trains, Train{std::vector<Measures::Held>(stretches_.size())}) {}

void Tally::spike(std::size_t number, double t) {
    auto& train = trains_[number];
    const std::size_t before = train.at;
    while (train.at < stretches_.size() && t >= stretches_[train.at].to) ++train.at;
    const bool here = train.at < stretches_.size() && t >= stretches_[train.at].from;
    if (!std::isnan(train.last)) each(train.in[before], [&](auto& m) { m.interval(train.last, t, here && train.at == before); });
    if (here) each(train.in[train.at], [&](auto& m) { m.spike(t, stretches_[train.at]); });
    train.last = here ? t : no_value;
}

void Tally::end(double t) {
    for (auto& s : stretches_)
        if (std::isinf(s.to)) s.to = t;
}

std::vector<double> Tally::values(std::size_t train, std::size_t stretch) const {
    std::vector<double> all;
    each(trains_[train].in[stretch], [&](const auto& m) { all.push_back(m.value(stretches_[stretch])); });
    return all;
}

std::vector<double> instantaneous_rates(std::span<const double> train) {
    std::vector<double> rates;
    for (std::size_t k = 0; k + 1 < train.size(); ++k) rates.push_back(rate_between(train[k], train[k + 1]));
    return rates;
}

}  // namespace corpuscle
