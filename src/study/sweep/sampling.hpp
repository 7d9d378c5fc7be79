#pragma once
// What an axis draws: numbers between 0 and 1 for one draw after another, each known by itself, and what a distribution makes of them.

#include <array>
#include <cstdint>
#include <string_view>

namespace corpuscle::sweeps {

enum class Sampling { random, latin, sobol };

/// The numbers of one axis: they depend on seed, name and draw; of a Latin hypercube also on how many draws there are, of Sobol's points on
/// the dimension.
class UnitNumbers {
    Sampling how_;
    std::uint64_t key_, stream_, of_;
    std::array<std::uint32_t, 32> directions_{};
    std::uint32_t shift_ = 0;
    unsigned half_bits_ = 1;  // of the permutation

    std::uint64_t shuffled(std::uint64_t draw) const;

public:
    UnitNumbers(Sampling how, std::uint64_t seed, std::string_view axis, std::size_t dimension, std::uint64_t of);
    /// In (0, 1).
    double at(std::uint64_t draw) const;
};

/// The standard normal deviate that a share u of all lies below, 0 < u < 1: Wichura, algorithm AS 241, Appl. Stat. 37 (1988), to 1e-16.
double normal_quantile(double u);
/// The other way round: by halving, to the last digits of u.
double normal_share(double deviate);

}  // namespace corpuscle::sweeps
