#include "sweep/spec/sampling.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/random.hpp"
#include "sweep/spec/sobol.hpp"

namespace corpuscle::sweeps {
namespace {

constexpr std::uint64_t sweep_key = 0x7377656570;  // changes the key, because the samples of chips use the seed itself as their key
constexpr unsigned feistel_rounds = 8;

/// The number of the random stream of this name: its FNV-1a hash.
std::uint64_t stream_named(std::string_view name) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return hash;
}

PhiloxCounter random_words(std::uint64_t key, std::uint64_t stream, std::uint64_t index) {
    return philox({static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32), static_cast<std::uint32_t>(stream),
                   static_cast<std::uint32_t>(stream >> 32)},
                  key);
}

/// A number in (0, 1) from 53 of these 64 random bits.
double uniform_fraction(std::uint32_t high, std::uint32_t low) {
    return (static_cast<double>((std::uint64_t{high} << 21) | (low >> 11)) + 0.5) * 0x1p-53;
}

/// c[0] + c[1] x + ... + c[7] x^7.
double polynomial(const double (&c)[8], double x) {
    double y = c[7];
    for (int k = 6; k >= 0; --k) y = y * x + c[k];
    return y;
}

}  // namespace

UniformNumbers::UniformNumbers(Sampling method, std::uint64_t seed, std::string_view axis, std::size_t dimension, std::uint64_t count)
    : method_(method), key_(seed ^ sweep_key), stream_(stream_named(axis)), count_(std::max<std::uint64_t>(count, 1)) {
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
    const double u = uniform_fraction(w[0], w[1]);
    if (method_ == Sampling::random) return u;
    return std::clamp((static_cast<double>(shuffled(sample)) + u) / static_cast<double>(count_), 0x1p-60, 1 - 0x1p-53);
}

double normal_quantile(double u) {
    static constexpr double a[8] = {3.3871328727963666080e0, 1.3314166789178437745e2, 1.9715909503065514427e3, 1.3731693765509461125e4,
                                    4.5921953931549871457e4, 6.7265770927008700853e4, 3.3430575583588128105e4, 2.5090809287301226727e3},
                            b[8] = {1.0,
                                    4.2313330701600911252e1,
                                    6.8718700749205790830e2,
                                    5.3941960214247511077e3,
                                    2.1213794301586595867e4,
                                    3.9307895800092710610e4,
                                    2.8729085735721942674e4,
                                    5.2264952788528545610e3},
                            c[8] = {1.42343711074968357734e0,  4.63033784615654529590e0, 5.76949722146069140550e0,
                                    3.64784832476320460504e0,  1.27045825245236838258e0, 2.41780725177450611770e-1,
                                    2.27238449892691845833e-2, 7.74545014278341407640e-4},
                            d[8] = {1.0,
                                    2.05319162663775882187e0,
                                    1.67638483018380384940e0,
                                    6.89767334985100004550e-1,
                                    1.48103976427480074590e-1,
                                    1.51986665636164571966e-2,
                                    5.47593808499534494600e-4,
                                    1.05075007164441684324e-9},
                            e[8] = {6.65790464350110377720e0,  5.46378491116411436990e0,  1.78482653991729133580e0,
                                    2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                    2.71155556874348757815e-5, 2.01033439929228813265e-7},
                            f[8] = {1.0,
                                    5.99832206555887937690e-1,
                                    1.36929880922735805310e-1,
                                    1.48753612908506148525e-2,
                                    7.86869131145613259100e-4,
                                    1.84631831751005468180e-5,
                                    1.42151175831644588870e-7,
                                    2.04426310338993978564e-15};
    const double centred = u - 0.5;  // a ... f and the ranges of r are those of the algorithm
    if (std::abs(centred) <= 0.425) {
        const double r = 0.180625 - centred * centred;
        return centred * polynomial(a, r) / polynomial(b, r);
    }
    const double r = num::sqrt(-num::log(centred < 0 ? u : 1 - u));
    const double x = r <= 5 ? polynomial(c, r - 1.6) / polynomial(d, r - 1.6) : polynomial(e, r - 5) / polynomial(f, r - 5);
    return centred < 0 ? -x : x;
}

double normal_probability(double deviate) {
    double low = 0, high = 1;
    for (int k = 0; k < 1100; ++k) {
        const double midpoint = low + (high - low) / 2;
        if (!(midpoint > low && midpoint < high) || midpoint < 0x1p-1000) break;  // no number is between low and high
        (normal_quantile(midpoint) < deviate ? low : high) = midpoint;
    }
    return low;
}

}  // namespace corpuscle::sweeps
