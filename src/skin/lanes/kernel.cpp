// The sums of FieldForce on SIMD lanes. The file is compiled once for each instruction set, CORPUSCLE_ISA. Only the table at its end may be
// visible to the linker.

#include "skin/lanes/kernel.hpp"

#include <cstring>
#include <utility>

#include "core/number/number.hpp"
#include "skin/stress_integral.hpp"

namespace corpuscle::lanes {
namespace {

using T = num::Lanes<double>;
constexpr std::size_t width = T::size;  // lanes
constexpr std::size_t vectors = 8;      // vectors of sums that are computed together in registers

void sum_rows(const std::ptrdiff_t* row, std::size_t rows, const std::uint32_t* groups, const double* weights, const double* now,
              double* sums) {
    // row_groups: groups of weights in a row; at_once: afferents that are summed together
    constexpr std::size_t afferents = 64, row_groups = afferents / group_size, at_once = vectors * width;
    for (std::size_t u = 0; u < afferents; u += at_once) {
        T sum[vectors];
        for (auto& s : sum) s = T(0.0);
        for (std::size_t k = 0; k < rows; ++k) {
            const double* const f = now + row[k] + u;
            for (std::size_t i = 0; i < vectors; ++i) {  // a vector never crosses the end of a group, because width divides group_size
                const double* const w = weights + groups[k * row_groups + (u + i * width) / group_size] + i * width % group_size;
                sum[i] = sum[i] + T::load_aligned(w) * T::load_unaligned(f + i * width);
            }
        }
        for (std::size_t i = 0; i < vectors; ++i) sum[i].store_aligned(sums + u + i * width);
    }
}

void add_site(const std::uint32_t* afferent, const double* weight, std::size_t count, std::uint32_t origin, const double* force,
              std::size_t steps, double* sums, std::size_t stride) {
    const std::size_t full_vectors = steps / width * width;
    for (std::size_t k = 0; k < count; ++k) {
        double* const sum = sums + (afferent[k] - origin) * stride;
        const T w(weight[k]);
        for (std::size_t t = 0; t < full_vectors; t += width)
            (T::load_unaligned(sum + t) + w * T::load_unaligned(force + t)).store_unaligned(sum + t);
        for (std::size_t t = full_vectors; t < steps; ++t) sum[t] += weight[k] * force[t];
    }
}

void sum_afferent(const std::uint32_t* site, const double* weight, std::size_t count, const double* const* rows, std::size_t steps,
                  double* column, std::size_t stride) {
    constexpr std::size_t at_once = 16;  // the number of steps is usually a multiple of this
    std::size_t from = 0;
    for (; from + at_once <= steps; from += at_once) {
        T sum[at_once / width];
        for (auto& s : sum) s = T(0.0);
        for (std::size_t k = 0; k < count; ++k) {
            const double* const f = rows[site[k]] + from;
            const T w(weight[k]);
            for (std::size_t i = 0; i < at_once / width; ++i) sum[i] = sum[i] + w * T::load_unaligned(f + i * width);
        }
        alignas(64) double sums[at_once];
        for (std::size_t i = 0; i < at_once / width; ++i) sum[i].store_aligned(sums + i * width);
        for (std::size_t t = 0; t < at_once; ++t) column[(from + t) * stride] = sums[t];
    }
    for (; from < steps; ++from) {
        double sum = 0;
        for (std::size_t k = 0; k < count; ++k) sum += weight[k] * rows[site[k]][from];
        column[from * stride] = sum;
    }
}

void sum_delayed(const DelayedTerm* terms, std::size_t count, std::size_t steps, double* sums) {
    constexpr std::size_t at_once = 32;  // the number of steps is usually this
    std::size_t from = 0;
    for (; from + at_once <= steps; from += at_once) {
        T sum[at_once / width];
        for (auto& s : sum) s = T(0.0);
        for (const auto* term = terms; term != terms + count; ++term) {
            const T now(term->weight), before(term->weight_before);
            const double* const f = term->value + from;
            for (std::size_t i = 0; i < at_once / width; ++i)
                sum[i] = sum[i] + now * T::load_unaligned(f + i * width) + before * T::load_unaligned(f + i * width - 1);
        }
        for (std::size_t i = 0; i < at_once / width; ++i) sum[i].store_unaligned(sums + from + i * width);
    }
    for (; from < steps; ++from) {
        double sum = 0;
        for (const auto* term = terms; term != terms + count; ++term)
            sum = sum + term->weight * term->value[from] + term->weight_before * term->value[static_cast<std::ptrdiff_t>(from) - 1];
        sums[from] = sum;
    }
}

/// A register of T, whose elements the compiler can shuffle.
using Shuffled [[gnu::vector_size(width * sizeof(double))]] = double;

/// The elements 0, width, 1, width + 1 ... of `low` and `high` one after the other, from element `from` of each on.
template <std::size_t from, std::size_t... k>
[[gnu::always_inline]] inline Shuffled interleaved(Shuffled low, Shuffled high, std::index_sequence<k...>) {
    return __builtin_shufflevector(low, high, static_cast<int>(from + k / 2 + k % 2 * width)...);
}

/// Transposes a square of `width` registers: in each pass, register i is interleaved with register i + width / 2.
[[gnu::always_inline]] inline void transpose_square(Shuffled (&x)[width]) {
    constexpr auto all = std::make_index_sequence<width>{};
    for (std::size_t pass = 1; pass < width; pass *= 2) {
        Shuffled next[width];
        for (std::size_t i = 0; i < width / 2; ++i) {
            next[2 * i] = interleaved<0>(x[i], x[i + width / 2], all);
            next[2 * i + 1] = interleaved<width / 2>(x[i], x[i + width / 2], all);
        }
        for (std::size_t i = 0; i < width; ++i) x[i] = next[i];
    }
}

template <bool adds>
void transpose_tile(const double* const* columns, std::size_t steps, const double* base, std::size_t base_stride, double* rows) {
    constexpr std::size_t afferents = 64;
    const std::size_t squares = steps / width * width;
    for (std::size_t u = 0; u < afferents; u += width)
        for (std::size_t t = 0; t < squares; t += width) {
            Shuffled x[width];
            for (std::size_t i = 0; i < width; ++i) x[i] = (Shuffled)T::load_unaligned(columns[u + i] + t).data;
            transpose_square(x);
            for (std::size_t i = 0; i < width; ++i) {
                if constexpr (adds) x[i] = (Shuffled)T::load_unaligned(base + (t + i) * base_stride + u).data + x[i];
                std::memcpy(rows + (t + i) * afferents + u, &x[i], sizeof x[i]);
            }
        }
    for (std::size_t t = squares; t < steps; ++t)
        for (std::size_t u = 0; u < afferents; ++u)
            rows[t * afferents + u] = adds ? base[t * base_stride + u] + columns[u][t] : columns[u][t];
}
void transpose(const double* const* columns, std::size_t steps, const double* base, std::size_t base_stride, double* rows) {
    base ? transpose_tile<true>(columns, steps, base, base_stride, rows) : transpose_tile<false>(columns, steps, base, base_stride, rows);
}

void stress_corners(double depth, double x, const double* y, std::size_t count, double* out) {
    std::size_t k = 0;
    for (; k + width <= count; k += width) stress_integral(T(x), T::load_unaligned(y + k), T(depth)).store_unaligned(out + k);
    if (k == count) return;
    alignas(64) double rest[width];
    for (std::size_t l = 0; l < width; ++l) rest[l] = y[k + l < count ? k + l : count - 1];
    stress_integral(T(x), T::load_aligned(rest), T(depth)).store_aligned(rest);
    for (std::size_t l = 0; k + l < count; ++l) out[k + l] = rest[l];
}

}  // namespace

namespace CORPUSCLE_ISA {
const FieldKernels field_kernels{sum_rows, add_site, sum_afferent, sum_delayed, transpose, stress_corners};
}

}  // namespace corpuscle::lanes
