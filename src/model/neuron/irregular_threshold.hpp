#pragma once
// A random factor for the threshold of a neuron, drawn anew at each spike: intervals between spikes become irregular.

#include <string_view>

#include "core/number/elementary.hpp"

namespace corpuscle {

/// The parameter of a neuron that is the deviation of this factor.
inline constexpr std::string_view jitter_name = "jitter";

/// The random numbers are those of Wichmann and Hill (Applied Statistics 31:188, 1982, AS 183). Their integers stay below 2^23, so lanes of
/// float and double compute them exactly, and every machine draws the same.
template <class T>
struct IrregularThreshold {
    T factor, a, b, c;  // of the threshold; state of the generator

    /// `stream` in [0, 1) selects the sequence of an afferent. The first factor is 1.
    static IrregularThreshold start(T stream) {
        const T first = floor(stream * T(16384.0)), rest = floor((stream * T(16384.0) - first) * T(1024.0));
        return {T(1.0), first + T(1.0), rest * T(29.0) + T(1.0), T(3172.0)};
    }

    /// The next state. The factor has the mean 1, the standard deviation `deviation`, and differs from 1 by at most three deviations.
    IrregularThreshold next(T deviation) const {
        IrregularThreshold n = *this;
        T sum(-1.5);
        for (int k = 0; k < 3; ++k) sum = sum + n.draw();
        n.factor = T(1.0) + T(2.0) * deviation * sum;
        return n;
    }

private:
    static T floor(T x) {
        const T near = num::nearest(x);
        return near - num::select(near > x, T(1.0), T(0.0));
    }
    /// x modulo m, for integers 0 <= x < 2^23.
    static T modulo(T x, double m) {
        const T rest = x - floor(x * T(1.0 / m)) * T(m);  // rounding of x / m may make it m too small or too large
        return rest + num::select(rest < T(0.0), T(m), T(0.0)) - num::select(rest >= T(m), T(m), T(0.0));
    }
    /// A random number in [0, 1).
    T draw() {
        a = modulo(T(171.0) * a, 30269), b = modulo(T(172.0) * b, 30307), c = modulo(T(170.0) * c, 30323);
        const T sum = a * T(1.0 / 30269) + b * T(1.0 / 30307) + c * T(1.0 / 30323);
        return sum - floor(sum);
    }
};

}  // namespace corpuscle
