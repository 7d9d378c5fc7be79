#pragma once
// SIMD lanes as a kind of number: what number.hpp offers for double, for xsimd's batches of double and float. Included by
// number.hpp alone, and only in files compiled for one instruction set (see cmake/lanes.cmake).

#include <xsimd/xsimd.hpp>

#include <concepts>
#include <cstdint>

#ifdef __AVX512F__
// xsimd negates for AVX-512 by 0 - x, which gives 0 where -0 is right. On every other instruction set, and for a double, only the sign
// changes.
template <>
inline xsimd::batch<double> xsimd::batch<double>::operator-() const noexcept {
    return -data;
}
template <>
inline xsimd::batch<float> xsimd::batch<float>::operator-() const noexcept {
    return -data;
}
#endif

namespace corpuscle::num {

/// As many numbers as a register of this instruction set holds.
template <class V>
using Lanes = xsimd::batch<V>;

template <class V>
struct MaskOf<Lanes<V>> {
    using type = xsimd::batch_bool<V>;
};

template <class V>
bool any(xsimd::batch_bool<V> m) {
    return xsimd::any(m);
}
template <class V>
bool all(xsimd::batch_bool<V> m) {
    return xsimd::all(m);
}
/// Whether any of several masks has a lane. (For AVX-512 two at once: or-ing them would send each through a general register.)
template <std::size_t J, class V>
[[gnu::always_inline]] inline bool any_of(const xsimd::batch_bool<V> (&m)[J]) {
    bool any = false;
#ifdef __AVX512F__
    for (std::size_t j = 0; j < J; j += 2) {
        const auto first = m[j].data, second = m[j + 1 < J ? j + 1 : j].data;
        if constexpr (sizeof(V) == 8)
            any = any || !_kortestz_mask8_u8(first, second);
        else
            any = any || !_kortestz_mask16_u8(first, second);
    }
#else
    auto all = m[0];
    for (std::size_t j = 1; j < J; ++j) all = all | m[j];
    any = xsimd::any(all);
#endif
    return any;
}
template <class V>
Lanes<V> select(xsimd::batch_bool<V> m, Lanes<V> yes, Lanes<V> no) {
    return xsimd::select(m, yes, no);
}
template <class V>
Lanes<V> sqrt(Lanes<V> x) {
    return xsimd::sqrt(x);
}

/// a > b ? a : b and a < b ? a : b: what the instructions do, with equal zeros and what is no number, too.
template <class V>
Lanes<V> max(Lanes<V> a, Lanes<V> b) {
    return xsimd::max(a, b);
}
template <class V>
Lanes<V> min(Lanes<V> a, Lanes<V> b) {
    return xsimd::min(a, b);
}

/// A bit for each lane, the first lowest.
template <class V>
std::uint64_t bits(xsimd::batch_bool<V> m) {
#if defined(__AVX512F__)
    return m.data;
#elif defined(__AVX2__)
    if constexpr (sizeof(V) == 8)
        return static_cast<unsigned>(_mm256_movemask_pd(m.data));
    else
        return static_cast<unsigned>(_mm256_movemask_ps(m.data));
#else
    alignas(64) bool lanes[Lanes<V>::size];
    m.store_aligned(lanes);
    std::uint64_t all = 0;
    for (std::size_t l = 0; l < Lanes<V>::size; ++l) all |= std::uint64_t{lanes[l]} << l;
    return all;
#endif
}

/// Integers of 16 bits, as many as there are lanes.
template <class V>
Lanes<V> of_words(const std::int16_t* words) {
#if defined(__AVX512F__)
    if constexpr (sizeof(V) == 8)
        return _mm512_cvtepi32_pd(_mm256_cvtepi16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(words))));
    else
        return _mm512_cvtepi32_ps(_mm512_cvtepi16_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(words))));
#elif defined(__AVX2__)
    if constexpr (sizeof(V) == 8)
        return _mm256_cvtepi32_pd(_mm_cvtepi16_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(words))));
    else
        return _mm256_cvtepi32_ps(_mm256_cvtepi16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(words))));
#else
    alignas(64) V lanes[Lanes<V>::size];
    for (std::size_t l = 0; l < Lanes<V>::size; ++l) lanes[l] = static_cast<V>(words[l]);
    return Lanes<V>::load_aligned(lanes);
#endif
}

/// Floats, as many as there are lanes.
template <class V>
Lanes<V> of_floats(const float* floats) {
#if defined(__AVX512F__)
    if constexpr (sizeof(V) == 8)
        return _mm512_cvtps_pd(_mm256_loadu_ps(floats));
    else
        return _mm512_loadu_ps(floats);
#elif defined(__AVX2__)
    if constexpr (sizeof(V) == 8)
        return _mm256_cvtps_pd(_mm_loadu_ps(floats));
    else
        return _mm256_loadu_ps(floats);
#else
    alignas(64) V lanes[Lanes<V>::size];
    for (std::size_t l = 0; l < Lanes<V>::size; ++l) lanes[l] = static_cast<V>(floats[l]);
    return Lanes<V>::load_aligned(lanes);
#endif
}

template <class T>
Mask<T> none();
template <>
inline xsimd::batch_bool<double> none<Lanes<double>>() {
    return xsimd::batch_bool<double>(false);
}
template <>
inline xsimd::batch_bool<float> none<Lanes<float>>() {
    return xsimd::batch_bool<float>(false);
}

/// The same bits read as numbers of type To. (xsimd 12 and later names the element's type, xsimd 8 the batch's.)
template <class To, class V>
xsimd::batch<To> bits_as(xsimd::batch<V> x) {
    if constexpr (requires {
                      { xsimd::bitwise_cast<To>(x) } -> std::same_as<xsimd::batch<To>>;
                  })
        return xsimd::bitwise_cast<To>(x);
    else
        return xsimd::bitwise_cast<xsimd::batch<To>>(x);
}

// How each precision is laid out in its bits; the rest of the arithmetic below follows from it.
template <class V>
struct Layout;
template <>
struct Layout<double> {
    using Bits = std::uint64_t;
    static constexpr int digits = 52, bias = 1023;
    static constexpr double integers_from = 0x1p52;
};
template <>
struct Layout<float> {
    using Bits = std::uint32_t;
    static constexpr int digits = 23, bias = 127;
    static constexpr float integers_from = 0x1p23F;
};

template <class V>
Lanes<V> nearest(Lanes<V> x) {
    const Lanes<V> big(V(1.5) * Layout<V>::integers_from);
    return (x + big) - big;
}
template <class V>
Lanes<V> times_power_of_two(Lanes<V> x, Lanes<V> k) {
    using Bits = typename Layout<V>::Bits;  // an integer below 2^52 added to 2^52 stands in the lowest bits
    const auto shifted = bits_as<Bits>(k + Lanes<V>(Layout<V>::integers_from + V(Layout<V>::bias)));
    return x * bits_as<V>(shifted << Layout<V>::digits);
}
template <class V>
Lanes<V> mantissa(Lanes<V> x) {
    using Bits = typename Layout<V>::Bits;
    const xsimd::batch<Bits> below((Bits{1} << Layout<V>::digits) - 1), one(Bits{Layout<V>::bias} << Layout<V>::digits);
    return bits_as<V>((bits_as<Bits>(x) & below) | one);
}
template <class V>
Lanes<V> exponent(Lanes<V> x) {
    using Bits = typename Layout<V>::Bits;
    const auto integers = bits_as<Bits>(Lanes<V>(Layout<V>::integers_from));
    const auto raised = (bits_as<Bits>(x) >> Layout<V>::digits) | integers;
    return bits_as<V>(raised) - Lanes<V>(Layout<V>::integers_from + V(Layout<V>::bias));
}

template <>
inline constexpr double exp_reach<Lanes<float>> = 87;
template <>
inline constexpr double series_reach<Lanes<float>> = 0.3;

}  // namespace corpuscle::num
