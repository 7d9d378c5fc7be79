#pragma once
// Sobol points, which fill a cube more evenly than random ones.

#include <array>
#include <cstddef>
#include <cstdint>

namespace corpuscle::sweeps {

inline constexpr std::size_t sobol_dimensions = 50;

/// The direction numbers of a dimension, counted from 0, as fractions of 2^32.
std::array<std::uint32_t, 32> sobol_directions(std::size_t dimension);

/// A coordinate of a point, counted from 0, in Gray-code order, as a fraction of 2^32.
std::uint32_t sobol_point(const std::array<std::uint32_t, 32>& directions, std::uint32_t number);

}  // namespace corpuscle::sweeps
