#pragma once
// Random oscillators, filters and rectifiers over twelve decades of current and capacitance, each with a check of its transient.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "circuit/transient_runner.hpp"

namespace corpuscle::circuit {

struct RandomCircuit {
    std::string text;                              ///< a netlist with .tran; file names are relative to process/
    double min_voltage = -1e9, max_voltage = 1e9;  ///< V; range that no node voltage may leave
    TransientPlan plan{};  ///< the default, or with tighter tolerances where an error of 10 uV per step is too large
    /// Returns a description of the fault of a finished run; empty if the run is right.
    std::function<std::string(const TransientRunner&, const TransientPoints&)> find_fault =
        [](const TransientRunner&, const TransientPoints&) { return std::string(); };
};

/// Random numbers that are the same on every platform.
class RandomSource {
    std::uint64_t state_;

public:
    explicit RandomSource(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15U + 0x2545F4914F6CDD1DU) {}
    double uniform();  ///< in [0, 1)
    double uniform_between(double low, double high) { return low + (high - low) * uniform(); }
    double log_uniform(double low, double high);  ///< in [low, high), with a uniform logarithm
    /// An integer from 0 to count - 1.
    int index_below(int count) { return static_cast<int>(uniform() * count); }
};

/// A kind of random circuit.
struct RandomKind {
    std::string_view name;
    int count_per_thousand;                ///< number of circuits of this kind per thousand
    RandomCircuit (*make)(RandomSource&);  ///< makes the next circuit of this kind
};

/// All kinds. Their counts per thousand add up to 1000.
const std::vector<RandomKind>& random_kinds();

}  // namespace corpuscle::circuit
