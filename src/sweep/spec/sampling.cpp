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

}  // namespace corpuscle::sweeps
