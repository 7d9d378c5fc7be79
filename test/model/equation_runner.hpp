#pragma once
// Simulates an afferent from the text of its equations alone, by the Runge-Kutta method.

#include <vector>

#include "model/equations/afferent_equations.hpp"

namespace corpuscle::test {

/// A quantity's value at every sample.
struct EquationResponse {
    std::vector<double> spikes;                 ///< s
    std::vector<std::vector<double>> currents;  ///< of each current of the receptor, A, at each sample; as many as the receptor has
};

/// Simulates under a force (N) that is a straight line between samples, with one step of dt (s) for each sample.
EquationResponse run_equations(const AfferentEquations&, const std::vector<double>& force, double dt);

}  // namespace corpuscle::test
