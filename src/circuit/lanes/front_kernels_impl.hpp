#pragma once
// Kernels of dense matrices. T is a vector of lanes. All sums are taken element by element, c -= a b in the order of the pivots, so that
// neither the width of T nor the size of a block changes a result.

#include <algorithm>
#include <cmath>

#include "circuit/lanes/front_kernels.hpp"
#include "core/number/number.hpp"

namespace corpuscle::circuit::lanes {
namespace {

template <class T>
inline constexpr std::size_t tile_rows = 2 * T::size;  // a tile is this high and up to tile_columns wide
inline constexpr std::size_t tile_columns = 4;

/// to -= factor from, for `count` numbers and up to front_padding more.
template <class T>
[[gnu::always_inline]] inline void subtract_multiple(double factor, const double* from, double* to, std::size_t count) {
    const T f(factor);
    std::size_t k = 0;
    for (; k + T::size <= count; k += T::size) (T::load_unaligned(to + k) - f * T::load_unaligned(from + k)).store_unaligned(to + k);
    for (; k < count; ++k) to[k] -= factor * from[k];
}

/// Multiplies `count` numbers by a factor. Returns the largest magnitude of the products.
template <class T>
[[gnu::always_inline]] inline double scale_column(double* x, double factor, std::size_t count) {
    const T f(factor);
    T largest(0.0);
    std::size_t k = 0;
    for (; k + T::size <= count; k += T::size) {
        const T product = T::load_unaligned(x + k) * f;
        product.store_unaligned(x + k);
        largest = num::max(num::abs(product), largest);
    }
    alignas(64) double lanes[T::size];
    largest.store_aligned(lanes);
    double out = 0;
    for (const double m : lanes) out = std::max(m, out);
    for (; k < count; ++k) x[k] *= factor, out = std::max(std::abs(x[k]), out);
    return out;
}

/// Eliminates the pivots begin to end - 1 in their columns. Returns the largest multiplier.
template <class T>
double factor_panel(const Front& f, std::size_t begin, std::size_t end) {
    double largest = 0;
    for (std::size_t p = begin; p < end; ++p) {
        double* const column = f.values + p * f.stride;
        const double inverse = 1 / column[p];
        f.inverse_pivot[p] = inverse;
        double factors[front_block];  // of this pivot's column in the later ones of the panel
        for (std::size_t j = p + 1; j < end; ++j) factors[j - begin] = f.is_symmetric ? column[j] : f.values[j * f.stride + p];
        if (!(std::abs(inverse) < 1e300)) return std::abs(inverse);
        largest = std::max(scale_column<T>(column + p + 1, inverse, f.size - p - 1), largest);
        for (std::size_t j = p + 1; j < end; ++j)
            subtract_multiple<T>(factors[j - begin], column + p + 1, f.values + j * f.stride + p + 1, f.size - p - 1);
    }
    return largest;
}

/// Computes the rows begin to end - 1 of U right of the panel.
inline void solve_rows(const Front& f, std::size_t begin, std::size_t end) {
    for (std::size_t j = end; j < f.size; ++j) {
        double* const column = f.values + j * f.stride;
        for (std::size_t p = begin; p < end; ++p)
            for (std::size_t i = p + 1; i < end; ++i) column[i] -= f.values[p * f.stride + i] * column[p];
    }
}

/// c -= a b for a tile: a [count][tile_rows], b [count][tile_columns], c in columns.
template <class T, std::size_t columns>
[[gnu::always_inline]] inline void update_tile(std::size_t count, const double* a, const double* b, double* c, std::size_t stride) {
    T low[columns], high[columns];
    for (std::size_t j = 0; j < columns; ++j)
        low[j] = T::load_unaligned(c + j * stride), high[j] = T::load_unaligned(c + j * stride + T::size);
    for (std::size_t p = 0; p < count; ++p, a += tile_rows<T>, b += tile_columns) {
        const T a_low = T::load_aligned(a), a_high = T::load_aligned(a + T::size);
        for (std::size_t j = 0; j < columns; ++j) {
            const T factor(b[j]);
            low[j] = low[j] - a_low * factor, high[j] = high[j] - a_high * factor;
        }
    }
    for (std::size_t j = 0; j < columns; ++j) low[j].store_unaligned(c + j * stride), high[j].store_unaligned(c + j * stride + T::size);
}

/// Copies the panel's columns of L below it into `rows`, tile by tile.
template <class T>
void pack_rows(const Front& f, std::size_t begin, std::size_t end) {
    double* to = f.rows;
    for (std::size_t i = end; i < f.size; i += tile_rows<T>)
        for (std::size_t p = begin; p < end; ++p, to += tile_rows<T>) {
            const double* const from = f.values + p * f.stride + i;
            T::load_unaligned(from).store_aligned(to), T::load_unaligned(from + T::size).store_aligned(to + T::size);
        }
}

/// Copies the panel's rows of U right of it into `columns`, tile by tile. If symmetric, they are D L^T.
inline void pack_columns(const Front& f, std::size_t begin, std::size_t end) {
    double* to = f.columns;
    for (std::size_t j = end; j < f.size; j += tile_columns)
        for (std::size_t p = begin; p < end; ++p)
            for (std::size_t k = j; k < j + tile_columns; ++k, ++to) {
                if (k >= f.size)
                    *to = 0;
                else
                    *to = f.is_symmetric ? f.values[p * f.stride + p] * f.values[p * f.stride + k] : f.values[k * f.stride + p];
            }
}

/// Subtracts the product of the panel's L and U from the rest of the front.
template <class T>
void update_rest(const Front& f, std::size_t begin, std::size_t end) {
    const std::size_t count = end - begin;
    pack_rows<T>(f, begin, end), pack_columns(f, begin, end);
    for (std::size_t i = end; i < f.size; i += tile_rows<T>) {
        const double* const a = f.rows + (i - end) * count;
        const std::size_t last = f.is_symmetric && i + tile_rows<T> < f.size ? i + tile_rows<T> : f.size;
        std::size_t j = end;
        for (; j + tile_columns <= last; j += tile_columns)
            update_tile<T, tile_columns>(count, a, f.columns + (j - end) * count, f.values + j * f.stride + i, f.stride);
        for (std::size_t k = 0; j + k < last; ++k)
            update_tile<T, 1>(count, a, f.columns + (j - end) * count + k, f.values + (j + k) * f.stride + i, f.stride);
    }
}

template <class T>
double factor_front(const Front& front) {
    const Front f = front;  // a local copy cannot alias the stores
    double largest = 0;
    for (std::size_t begin = 0; begin < f.pivots; begin += front_block) {
        const std::size_t end = begin + front_block < f.pivots ? begin + front_block : f.pivots;
        const double multiplier = factor_panel<T>(f, begin, end);
        if (!(multiplier < 1e300)) return multiplier;
        largest = multiplier > largest ? multiplier : largest;
        if (end == f.size) break;
        if (!f.is_symmetric) solve_rows(f, begin, end);
        update_rest<T>(f, begin, end);
    }
    return largest;
}

template <class T>
void forward_front(const FrontFactors& factors, double* y, double* rest) {
    const FrontFactors f = factors;
    for (std::size_t p = 0; p < f.pivots; ++p) {
        const double* const column = f.lower + p * f.size;
        subtract_multiple<T>(y[p], column + p + 1, y + p + 1, f.pivots - p - 1);
        subtract_multiple<T>(y[p], column + f.pivots, rest, f.size - f.pivots);
    }
}

/// The sum of the products of two rows of numbers, in front_partial_sums sums for every width of T.
template <class T>
[[gnu::always_inline]] inline double dot(const double* a, const double* b, std::size_t count) {
    constexpr std::size_t parts = front_partial_sums / T::size;
    T sums[parts];
    for (auto& s : sums) s = T(0.0);
    std::size_t k = 0;
    for (; k + front_partial_sums <= count; k += front_partial_sums)
        for (std::size_t j = 0; j < parts; ++j)
            sums[j] = sums[j] + T::load_unaligned(a + k + j * T::size) * T::load_unaligned(b + k + j * T::size);
    alignas(64) double s[front_partial_sums];
    for (std::size_t j = 0; j < parts; ++j) sums[j].store_aligned(s + j * T::size);
    double total = ((s[0] + s[4]) + (s[1] + s[5])) + ((s[2] + s[6]) + (s[3] + s[7]));
    for (; k < count; ++k) total += a[k] * b[k];
    return total;
}

template <class T>
void backward_front(const FrontFactors& factors, double* y, const double* rest) {
    const FrontFactors f = factors;
    const std::size_t others = f.size - f.pivots;
    for (std::size_t p = f.pivots; p-- > 0;) {
        const double* const column = f.lower + p * f.size;
        if (f.upper == nullptr) {
            y[p] =
                y[p] * f.inverse_pivot[p] - dot<T>(column + f.pivots, rest, others) - dot<T>(column + p + 1, y + p + 1, f.pivots - p - 1);
        } else {
            y[p] = (y[p] - dot<T>(f.upper + p * others, rest, others)) * f.inverse_pivot[p];
            subtract_multiple<T>(y[p], column, y, p);
        }
    }
}

template <class T>
inline constexpr FrontKernels front_kernels_for{&factor_front<T>, &forward_front<T>, &backward_front<T>};

}  // namespace
}  // namespace corpuscle::circuit::lanes
