#include "circuit/random_circuits.hpp"

#include <fmt/format.h>

#include <array>
#include <numbers>

#include "circuit/random_kinds.hpp"

namespace corpuscle::circuit {

double RandomSource::uniform() {
    state_ += 0x9E3779B97F4A7C15U;  // splitmix64
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

double RandomSource::log_uniform(double low, double high) { return low * std::pow(high / low, uniform()); }

const std::vector<RandomKind>& random_kinds() {
    static const std::vector<RandomKind> kinds = {
        {"Relaxation", 200, make_relaxation},
        {"IdealRelaxation", 150, make_ideal_relaxation},
        {"Ring", 100, make_ring},
        {"IdealRing", 100, make_ideal_ring},
        {"FirstOrder", 150, make_first_order},
        {"SineFirstOrder", 75, make_sine_first_order},
        {"Tank", 75, make_tank},
        {"GmC", 100, make_gm_c},
        {"Rectifier", 50, make_rectifier},
    };
    return kinds;
}

}  // namespace corpuscle::circuit
