#pragma once
// The thesis's sampled algorithms, corrected by the errata; reference for the misprinted versions. The catalogue has models of the same
// algorithms (press::thesis_algorithm). test/model/thesis_test.cpp compares them with these functions.

#include <vector>

#include "study/study_curve.hpp"

namespace corpuscle::algorithms {

struct MembraneParams {
    double C = 500e-9, leak = 500e-9, theta = 0.5, reset = 0.25;  ///< F, A, V, V; u_rest is 0
};
struct MembraneResponse {
    std::vector<double> spikes;  ///< s
    StudyCurve u;                ///< membrane voltage, V, over time, s
};

/// Algorithm 4: u[n] = u[n-1] + (T / C) (I[n] - I_leak0). `current` in A over time in s, in equal steps.
MembraneResponse lif_b(const StudyCurve& current, const MembraneParams&);

/// Factor k_x2 of Algorithms 5 and 6 for a corner frequency f (Hz) and a time step T (s); k_x1 = K k_x2.
double k2(double f, double T);

}  // namespace corpuscle::algorithms
