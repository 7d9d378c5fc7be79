#pragma once
// A circuit switched on.

#include "circuit/analysis/bench.hpp"

namespace corpuscle::circuit {

/// Where it stands long after all its sources have risen from 0 within `rise` (s), from 0 V everywhere and without .ic. Nothing: it swings
/// on.
Result<std::optional<std::vector<double>>> powered_on(const TestBench&, double rise);

}  // namespace corpuscle::circuit
