#pragma once
// Oscillators and filters drawn over twelve decades of current and of capacitance, each with what must be true of its run.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "circuit/transient_runner.hpp"

namespace corpuscle::circuit {

struct RandomCircuit {
    std::string text;               ///< a netlist with .tran; stands in process/
    double min_voltage = -1e9, max_voltage = 1e9;  ///< V: no node may leave these
    TransientPlan plan{};           ///< the default, but where 10 uV a step are too many
    /// What is wrong with a finished run, in words; empty: nothing.
    std::function<std::string(const TransientRunner&, const TransientPoints&)> find_fault = [](const TransientRunner&, const TransientPoints&) { return std::string(); };
};

/// Numbers that are the same everywhere.
class RandomSource {
    std::uint64_t state_;

public:
    explicit RandomSource(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15U + 0x2545F4914F6CDD1DU) {}
    double uniform();  ///< in [0, 1)
    double uniform_between(double low, double high) { return low + (high - low) * uniform(); }
    double log_uniform(double low, double high);  ///< as many in each decade
    int index_below(int count) { return static_cast<int>(uniform() * count); }
};

struct RandomKind {
    std::string_view name;
    int count_per_thousand;  ///< of a thousand
    RandomCircuit (*make)(RandomSource&);
};

/// All kinds, a thousand circuits between them.
const std::vector<RandomKind>& random_kinds();

}  // namespace corpuscle::circuit
