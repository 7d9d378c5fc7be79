#include "circuit/solve/past.hpp"

#include <algorithm>

namespace corpuscle::circuit {

void Past::accept() {
    first_ = (first_ + room - 1) % room;
    count_ = std::min(count_ + 1, most);
}

Past::Weights Past::value(double t, int points) const {
    Weights w{};
    for (int j = 0; j < points; ++j) {
        double part = 1;
        for (int i = 0; i < points; ++i)
            if (i != j) part *= (t - (*this)[i].t) / ((*this)[j].t - (*this)[i].t);
        w[static_cast<std::size_t>(j)] = part;
    }
    return w;
}

Past::Weights Past::slope(double t, int order, double& leading) const {
    Weights w{};
    leading = 0;
    for (int j = 0; j < order; ++j) {
        leading += 1 / (t - (*this)[j].t);
        double part = 1 / ((*this)[j].t - t);
        for (int i = 0; i < order; ++i)
            if (i != j) part *= (t - (*this)[i].t) / ((*this)[j].t - (*this)[i].t);
        w[static_cast<std::size_t>(j)] = part;
    }
    return w;
}

void Past::sum(const Weights& w, int points, std::vector<double> Moment::* member, std::span<double> out) const {
    const auto count = out.size();
    for (int j = 0; j < points; ++j) {
        const double* const from = ((*this)[j].*member).data();
        const double by = w[static_cast<std::size_t>(j)];
        for (std::size_t n = 0; n < count; ++n) out[n] = j == 0 ? by * from[n] : out[n] + by * from[n];
    }
}

}  // namespace corpuscle::circuit
