#pragma once
// The thesis's sampled algorithms, corrected by the errata; studies compare the misprinted versions with them. The catalogue has models of
// the same algorithms (run by press::thesis_algorithm). test/model/thesis_test.cpp compares those models with these functions.

#include <vector>

#include "reproduction/claims/study_curve.hpp"

namespace corpuscle::algorithms {

struct MembraneParams {
    double C = 500e-9, leak = 500e-9, theta = 0.5, reset = 0.25;  ///< F, A, V, V; leak is I_leak0, theta the threshold; u_rest is 0
};
struct MembraneResponse {
    std::vector<double> spikes;  ///< s
    StudyCurve u;                ///< membrane voltage, V, over time, s
};

/// Algorithm 4: u[n] = u[n-1] + (T / C) (I[n] - I_leak0), with u at least 0. If u[n] exceeds theta, there is a spike at the time of sample
/// n, and u is lowered by theta - reset. `current` is in A over time in s, in equal steps T.
MembraneResponse lif_b(const StudyCurve& current, const MembraneParams&);

/// Factor k_x2 of the high-pass filters of Algorithms 5 and 6 for a corner frequency f (Hz) and a time step T (s). The other factor of a
/// filter of gain K is k_x1 = K k_x2; x is the letter of the filter.
double k2(double f, double T);

}  // namespace corpuscle::algorithms
