#include "sweep/spec/sampling.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/random.hpp"

namespace corpuscle::sweeps {
namespace {

constexpr std::uint64_t sweep_key = 0x7377656570;  // changes the key, because the samples of chips use the seed itself as their key
constexpr unsigned feistel_rounds = 8;

PhiloxCounter random_words(std::uint64_t key, std::uint64_t stream, std::uint64_t index) {
    return philox({static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32), static_cast<std::uint32_t>(stream),
                   static_cast<std::uint32_t>(stream >> 32)},
                  key);
}

/// One dimension: a primitive polynomial over GF(2), whose bit k is the coefficient of x^k, and the initial direction numbers. From the
/// table new-joe-kuo-6 of Joe and Kuo, "Constructing Sobol sequences with better two-dimensional projections", SIAM J. Sci. Comput. 30
/// (2008), beginning with the second dimension: the first one needs no table. The licence of the table is in NOTICE.
struct InitialDirections {
    std::uint32_t polynomial;
    std::uint32_t m[9];
};
constexpr InitialDirections initial_directions[] = {
    {3, {1}},
    {7, {1, 3}},
    {11, {1, 3, 1}},
    {13, {1, 1, 1}},
    {19, {1, 1, 3, 3}},
    {25, {1, 3, 5, 13}},
    {37, {1, 1, 5, 5, 17}},
    {41, {1, 1, 5, 5, 5}},
    {47, {1, 1, 7, 11, 19}},
    {55, {1, 1, 5, 1, 1}},
    {59, {1, 1, 1, 3, 11}},
    {61, {1, 3, 5, 5, 31}},
    {67, {1, 3, 3, 9, 7, 49}},
    {91, {1, 1, 1, 15, 21, 21}},
    {97, {1, 3, 1, 13, 27, 49}},
    {103, {1, 1, 1, 15, 7, 5}},
    {109, {1, 3, 1, 15, 13, 25}},
    {115, {1, 1, 5, 5, 19, 61}},
    {131, {1, 3, 7, 11, 23, 15, 103}},
    {137, {1, 3, 7, 13, 13, 15, 69}},
    {143, {1, 1, 3, 13, 7, 35, 63}},
    {145, {1, 3, 5, 9, 1, 25, 53}},
    {157, {1, 3, 1, 13, 9, 35, 107}},
    {167, {1, 3, 1, 5, 27, 61, 31}},
    {171, {1, 1, 5, 11, 19, 41, 61}},
    {185, {1, 3, 5, 3, 3, 13, 69}},
    {191, {1, 1, 7, 13, 1, 19, 1}},
    {193, {1, 3, 7, 5, 13, 19, 59}},
    {203, {1, 1, 3, 9, 25, 29, 41}},
    {211, {1, 3, 5, 13, 23, 1, 55}},
    {213, {1, 3, 7, 3, 13, 59, 17}},
    {229, {1, 3, 1, 3, 5, 53, 69}},
    {239, {1, 1, 5, 5, 23, 33, 13}},
    {241, {1, 1, 7, 7, 1, 61, 123}},
    {247, {1, 1, 7, 9, 13, 61, 49}},
    {253, {1, 3, 3, 5, 3, 55, 33}},
    {285, {1, 3, 1, 15, 31, 13, 49, 245}},
    {299, {1, 3, 5, 15, 31, 59, 63, 97}},
    {301, {1, 3, 1, 11, 11, 11, 77, 249}},
    {333, {1, 3, 1, 11, 27, 43, 71, 9}},
    {351, {1, 1, 7, 15, 21, 11, 81, 45}},
    {355, {1, 3, 7, 3, 25, 31, 65, 79}},
    {357, {1, 3, 1, 1, 19, 11, 3, 205}},
    {361, {1, 1, 5, 9, 19, 21, 29, 157}},
    {369, {1, 3, 7, 11, 1, 33, 89, 185}},
    {391, {1, 3, 3, 3, 15, 9, 79, 71}},
    {397, {1, 3, 7, 11, 15, 39, 119, 27}},
    {425, {1, 1, 3, 1, 11, 31, 97, 225}},
    {451, {1, 1, 1, 3, 23, 43, 57, 177}},
};
static_assert(std::size(initial_directions) + 1 == sobol_dimensions);

}  // namespace

UniformNumbers::UniformNumbers(Sampling method, std::uint64_t seed, std::string_view axis, std::size_t dimension, std::uint64_t count)
    : method_(method), key_(seed ^ sweep_key), stream_(stream_id(axis)), count_(std::max<std::uint64_t>(count, 1)) {
    half_bits_ = static_cast<unsigned>(std::max(1, (static_cast<int>(std::bit_width(count_ - 1)) + 1) / 2));
    if (method != Sampling::sobol) return;
    directions_ = sobol_directions(dimension);
    shift_ = random_words(~key_, stream_, 0)[0];
}

/// A Feistel network permutes the numbers below the next power of 4; it is applied again until the result is an index of a sample.
std::uint64_t UniformNumbers::shuffled(std::uint64_t sample) const {
    const std::uint64_t mask = (std::uint64_t{1} << half_bits_) - 1;
    do {
        std::uint64_t left = sample >> half_bits_, right = sample & mask;
        for (unsigned round = 0; round < feistel_rounds; ++round) {
            const auto mixed = random_words(~key_ + round, stream_, right)[0] & mask;
            const auto next = left ^ mixed;
            left = right, right = next;
        }
        sample = left << half_bits_ | right;
    } while (sample >= count_);
    return sample;
}

double UniformNumbers::at(std::uint64_t sample) const {
    if (method_ == Sampling::sobol)
        return (static_cast<double>(sobol_point(directions_, static_cast<std::uint32_t>(sample)) ^ shift_) + 0.5) *
               0x1p-32;  // digital shift
    const auto w = random_words(key_, stream_, sample);
    const double u = unit_interval(w[0], w[1]);
    if (method_ == Sampling::random) return u;
    return std::clamp((static_cast<double>(shuffled(sample)) + u) / static_cast<double>(count_), 0x1p-60, 1 - 0x1p-53);
}

std::array<std::uint32_t, 32> sobol_directions(std::size_t dimension) {
    std::array<std::uint32_t, 32> v{};
    if (dimension == 0) {  // gives the van der Corput sequence
        for (std::size_t k = 0; k < 32; ++k) v[k] = std::uint32_t{1} << (31 - k);
        return v;
    }
    const auto& initial = initial_directions[dimension - 1];
    const auto degree = static_cast<std::size_t>(std::bit_width(initial.polynomial)) - 1;
    for (std::size_t k = 0; k < degree; ++k) v[k] = initial.m[k] << (31 - k);
    for (std::size_t k = degree; k < 32; ++k) {
        v[k] = v[k - degree] ^ (v[k - degree] >> degree);
        for (std::size_t j = 1; j < degree; ++j)
            if (initial.polynomial >> (degree - j) & 1) v[k] ^= v[k - j];
    }
    return v;
}

std::uint32_t sobol_point(const std::array<std::uint32_t, 32>& directions, std::uint32_t number) {
    std::uint32_t x = 0, gray = number ^ (number >> 1);
    for (std::size_t k = 0; gray != 0; ++k, gray >>= 1)
        if (gray & 1) x ^= directions[k];
    return x;
}

}  // namespace corpuscle::sweeps
