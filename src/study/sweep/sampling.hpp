#pragma once
// Sampling of an axis: a number between 0 and 1 for each sample, each computed independently, and the distributions made from them.

#include <array>
#include <cstdint>
#include <string_view>

namespace corpuscle::sweeps {

enum class Sampling { random, latin, sobol };

/// The numbers of one axis. They depend on seed, name and sample; for a Latin hypercube also on the number of samples, for Sobol points on
/// the dimension.
class UniformNumbers {
    Sampling method_;
    std::uint64_t key_, stream_, count_;
    std::array<std::uint32_t, 32> directions_{};
    std::uint32_t shift_ = 0;
    unsigned half_bits_ = 1;  // of the permutation

    std::uint64_t shuffled(std::uint64_t sample) const;

public:
    UniformNumbers(Sampling method, std::uint64_t seed, std::string_view axis, std::size_t dimension, std::uint64_t count);
    /// The number of this sample, in (0, 1).
    double at(std::uint64_t sample) const;
};

/// Quantile of the standard normal distribution, 0 < u < 1: Wichura, algorithm AS 241, Appl. Stat. 37 (1988), to 1e-16.
double normal_quantile(double u);
/// The inverse: cumulative probability of a standard normal deviate, by bisection to full precision.
double normal_probability(double deviate);

}  // namespace corpuscle::sweeps
