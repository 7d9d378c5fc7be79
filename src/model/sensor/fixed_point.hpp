#pragma once
// Arithmetic in two's complement words, as in small hardware. The rules are in doc/fixed-point.md.
//
// No intermediate result can overflow its 64 bits. A word n has at most 32 bits, so |n| <= 2^31. The mantissa M of a factor is in [0,
// 2^31), its shift in [0, 62]. So |n M| < 2^62, and with the rounding term, which is at most 2^61, the product stays below 2^63. A sum has
// at most four words and is below 2^34.

#include <fmt/format.h>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// A word, or a sum of a few words that is not yet saturated to one.
using Word = std::int64_t;

inline constexpr double uA_per_A = 1e6;  // microamperes per ampere

/// The nearest integer; halves are rounded up. This is exact, whereas floor(x + 0.5) is not, because the sum is rounded.
inline double rounded(double x) {
    const double down = std::floor(x);
    return x - down >= 0.5 ? down + 1 : down;
}

/// The format of words: `word` bits, of which `frac` are after the binary point.
struct WordFormat {
    int word = 32, frac = 20;
    Word max() const { return (Word{1} << (word - 1)) - 1; }
    Word min() const { return -(Word{1} << (word - 1)); }
    /// The word nearest to x, which must be within the range of a word.
    Word nearest(double x) const { return static_cast<Word>(rounded(std::ldexp(x, frac))); }
    /// The value of word n.
    double value(Word n) const { return std::ldexp(static_cast<double>(n), -frac); }
};

/// A constant factor, mantissa * 2^-shift. Large and small factors have the same number of significant bits.
struct Factor {
    Word mantissa = 0;
    int shift = 0;
};

/// The operations on words. A result that does not fit a word is replaced by the nearest word, and counted in `overflowed`.
struct Arithmetic {
    WordFormat format;
    std::int64_t overflowed = 0;

    /// The word nearest to an exact sum.
    Word saturate(Word sum) {
        if (sum > format.max()) return ++overflowed, format.max();
        if (sum < format.min()) return ++overflowed, format.min();
        return sum;
    }
    /// The product c n, rounded to the nearest word, halves up. (In C++20, >> of a negative number rounds down.)
    Word times(Factor c, Word n) {
        const Word half = c.shift > 0 ? Word{1} << (c.shift - 1) : 0;
        return saturate((n * c.mantissa + half) >> c.shift);
    }
    /// The absolute value of a word; for the lowest word this is too large by one and becomes the highest word.
    Word magnitude(Word n) { return n < 0 ? saturate(-n) : n; }
};

/// The constants of a FixedChain, computed once, with their names. Tools that rebuild the chain, such as hardware export, can list them.
/// Values of signals are in N, uA and V.
class Constants {
public:
    struct Constant {
        std::string name;
        double value;    ///< before rounding
        Word word;       ///< the mantissa of a factor; otherwise the level or the count
        int shift = -1;  ///< the shift of a factor; -1: the constant is a level or a count
    };

    Constants(WordFormat format) : format_(format) {}
    WordFormat format() const { return format_; }
    const std::vector<Constant>& all() const { return all_; }
    /// The error of the first constant that does not fit a word.
    const std::optional<Error>& error() const { return error_; }

    /// The constant factor c, which must not be negative. Its mantissa is in [2^(word-2), 2^(word-1)), or smaller if c is so small that the
    /// shift would exceed 62.
    Factor factor(std::string_view name, double c) {
        Factor f;
        if (c > 0) f.shift = std::min(format_.word - 2 - std::ilogb(c), 62);
        double mantissa = rounded(std::ldexp(c, f.shift));
        if (mantissa > static_cast<double>(format_.max())) mantissa /= 2, --f.shift;  // rounding made it 2^(word-1)
        if (f.shift < 0) return set_error(name, c), Factor{};
        f.mantissa = static_cast<Word>(mantissa);
        all_.push_back({std::string(name), c, f.mantissa, f.shift});
        return f;
    }
    /// A level, the constant value x of a signal, as a word.
    Word level(std::string_view name, double x) {
        const double n = rounded(std::ldexp(x, format_.frac));
        if (n > static_cast<double>(format_.max()) || n < static_cast<double>(format_.min())) return set_error(name, x), 0;
        all_.push_back({std::string(name), x, static_cast<Word>(n)});
        return all_.back().word;
    }
    /// A number of steps, as an integer.
    Word count(std::string_view name, double n) {
        all_.push_back({std::string(name), n, static_cast<Word>(rounded(n))});
        return all_.back().word;
    }

private:
    /// Keeps the first error; further ones are ignored.
    void set_error(std::string_view name, double x) {
        if (!error_)
            error_ =
                bad_input(fmt::format("{} = {:g} (units: N, uA, V, steps) does not fit a word of {} bits with {} fraction "
                                      "bits; raise word, or lower frac",
                                      name, x, format_.word, format_.frac));
    }

    WordFormat format_;
    std::vector<Constant> all_;
    std::optional<Error> error_;
};

}  // namespace corpuscle
