#pragma once
// Oscillators and filters drawn over twelve decades of current and of capacitance, each with what must be true of its run.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "circuit/in_time.hpp"

namespace corpuscle::circuit {

struct RandomCircuit {
    std::string text;               ///< a netlist with .tran; stands in process/
    double low = -1e9, high = 1e9;  ///< V: no node may leave these
    TransientPlan plan{};           ///< the default, but where 10 uV a step are too many
    /// What is wrong with a finished run, in words; empty: nothing.
    std::function<std::string(const InTime&, const Points&)> judge = [](const InTime&, const Points&) { return std::string(); };
};

/// Numbers that are the same everywhere.
class Dice {
    std::uint64_t state_;

public:
    explicit Dice(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15U + 0x2545F4914F6CDD1DU) {}
    double part();  ///< in [0, 1)
    double between(double low, double high) { return low + (high - low) * part(); }
    double decades(double low, double high);  ///< as many in each decade
    int one_of(int count) { return static_cast<int>(part() * count); }
};

struct RandomKind {
    std::string_view name;
    int many;  ///< of a thousand
    RandomCircuit (*draw)(Dice&);
};

/// All kinds, a thousand circuits between them.
const std::vector<RandomKind>& random_kinds();

}  // namespace corpuscle::circuit
