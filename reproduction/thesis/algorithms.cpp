#include "reproduction/thesis/algorithms.hpp"

#include <algorithm>
#include <cmath>

namespace corpuscle::algorithms {

MembraneResponse lif_b(const StudyCurve& current, const MembraneParams& m) {
    MembraneResponse out;
    const double T = current.x[1] - current.x[0];
    double u = 0;
    for (std::size_t n = 0; n < current.x.size(); ++n) {
        u += T / m.C * (current.y[n] - m.leak);
        if (u > m.theta) {
            u = u - m.theta + m.reset;
            out.spikes.push_back(current.x[n]);
        } else {
            u = std::max(u, 0.0);
        }
        out.u.x.push_back(current.x[n]), out.u.y.push_back(u);
    }
    return out;
}

double k2(double f, double T) { return 1 / (1 + 2 * M_PI * f * T); }

}  // namespace corpuscle::algorithms
