#pragma once
// Sampling of an axis: a number u between 0 and 1 for each sample, and the normal distribution, which turns u into a normal deviate. The
// number of sample k is computed without those of the other samples.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace corpuscle::sweeps {

/// Independent numbers, a Latin hypercube (one number in each of `count` equal intervals), or Sobol points with a random shift.
enum class Sampling { random, latin, sobol };

/// The uniformly distributed numbers of one axis. They depend on the seed, the axis's name and the index of the sample; for a Latin
/// hypercube also on the number of samples, for Sobol points also on the axis's dimension of the Sobol sequence.
class UniformNumbers {
    Sampling method_;
    std::uint64_t key_, stream_, count_;          // of the random numbers: key and stream; number of samples
    std::array<std::uint32_t, 32> directions_{};  // for Sobol points
    std::uint32_t shift_ = 0;                     // of Sobol points, by exclusive or
    unsigned half_bits_ = 1;                      // half the number of bits of an index in the permutation

    /// A random permutation of the sample indexes.
    std::uint64_t shuffled(std::uint64_t sample) const;

public:
    /// `axis`: name of the axis; `dimension`: from 0, only for Sobol points; `count`: number of samples.
    UniformNumbers(Sampling method, std::uint64_t seed, std::string_view axis, std::size_t dimension, std::uint64_t count);
    Sampling method() const { return method_; }
    /// The number of the sample with this index (from 0), in (0, 1).
    double at(std::uint64_t sample) const;
};

inline constexpr std::size_t sobol_dimensions = 50;  ///< largest number of dimensions

/// The direction numbers of one dimension (from 0), as fractions of 2^32: for each bit of the Gray code of a point's number, the lowest
/// first.
std::array<std::uint32_t, 32> sobol_directions(std::size_t dimension);

/// One coordinate of the point with this number (from 0, in Gray-code order), as a fraction of 2^32. `directions`: of the coordinate's
/// dimension.
std::uint32_t sobol_point(const std::array<std::uint32_t, 32>& directions, std::uint32_t number);

}  // namespace corpuscle::sweeps
