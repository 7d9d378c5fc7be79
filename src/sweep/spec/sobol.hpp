#pragma once
// Sobol sequence: points that fill a cube more evenly than random ones.

#include <array>
#include <cstddef>
#include <cstdint>

namespace corpuscle::sweeps {

inline constexpr std::size_t sobol_dimensions = 50;  ///< largest number of dimensions

/// The direction numbers of one dimension (from 0), as fractions of 2^32: for each bit of the Gray code of a point's number, the lowest
/// first.
std::array<std::uint32_t, 32> sobol_directions(std::size_t dimension);

/// One coordinate of the point with this number (from 0, in Gray-code order), as a fraction of 2^32. `directions`: of the coordinate's
/// dimension.
std::uint32_t sobol_point(const std::array<std::uint32_t, 32>& directions, std::uint32_t number);

}  // namespace corpuscle::sweeps
