#pragma once
// SIMD lanes as a number type: the operations of number.hpp for xsimd's batches of double and float. Only number.hpp includes this
// file, and only in files compiled for one instruction set (see cmake/lanes.cmake).

#include <xsimd/xsimd.hpp>

#include <concepts>
#include <cstdint>

#ifdef __AVX512F__
// On AVX-512 xsimd negates by 0 - x, which gives 0 instead of -0. Other instruction sets, and the scalar type double, change
// only the sign bit.
template <>
inline xsimd::batch<double> xsimd::batch<double>::operator-() const noexcept {
    return -data;
}
template <>
inline xsimd::batch<float> xsimd::batch<float>::operator-() const noexcept {
    return -data;
}
#endif
#if defined(__aarch64__)
// xsimd up to 13 divides floats by an estimate that it improves twice, which is not rounded correctly.
template <>
inline xsimd::batch<float>& xsimd::batch<float>::operator/=(const xsimd::batch<float>& divisor) noexcept {
    data = vdivq_f32(data, divisor.data);
    return *this;
}
#endif

namespace corpuscle::num {

/// One register of the instruction set for which the file is compiled, with elements of type V.
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
/// True if any lane of any of J masks is set. For AVX-512, one instruction tests two masks at once, because a bitwise or would move each
/// mask through a general register.
template <std::size_t J, class V>
[[gnu::always_inline]] inline bool any_of(const xsimd::batch_bool<V> (&m)[J]) {
    bool any = false;
#ifdef __AVX512F__
    for (std::size_t j = 0; j < J; j += 2) {
        const auto first = m[j].data, second = m[j + 1 < J ? j + 1 : j].data;  // an odd last mask is paired with itself
        if constexpr (sizeof(V) == 8)
            any = any || !_kortestz_mask8_u8(first, second);
        else
            any = any || !_kortestz_mask16_u8(first, second);
    }
#else
    auto combined = m[0];
    for (std::size_t j = 1; j < J; ++j) combined = combined | m[j];
    any = xsimd::any(combined);
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

/// max() is a > b ? a : b and min() is a < b ? a : b, also for NaN and for zeros of different sign. The instructions of x86-64 are defined
/// so; those of aarch64 return NaN if either is NaN.
template <class V>
Lanes<V> max(Lanes<V> a, Lanes<V> b) {
#ifdef __SSE2__
    return xsimd::max(a, b);
#else
    return xsimd::select(a > b, a, b);
#endif
}
template <class V>
Lanes<V> min(Lanes<V> a, Lanes<V> b) {
#ifdef __SSE2__
    return xsimd::min(a, b);
#else
    return xsimd::select(a < b, a, b);
#endif
}

/// The mask as an integer: one bit for each lane, the first lane lowest.
template <class V>
std::uint64_t mask_bits(xsimd::batch_bool<V> m) {
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
    std::uint64_t bits = 0;
    for (std::size_t l = 0; l < Lanes<V>::size; ++l) bits |= std::uint64_t{lanes[l]} << l;
    return bits;
#endif
}

/// Loads one 16-bit integer for each lane and converts it to V.
template <class V>
Lanes<V> load_int16(const std::int16_t* words) {
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

/// Loads one float for each lane and converts it to V.
template <class V>
Lanes<V> load_float(const float* floats) {
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
Mask<T> empty_mask();
template <>
inline xsimd::batch_bool<double> empty_mask<Lanes<double>>() {
    return xsimd::batch_bool<double>(false);
}
template <>
inline xsimd::batch_bool<float> empty_mask<Lanes<float>>() {
    return xsimd::batch_bool<float>(false);
}

/// Reinterprets the bits as elements of type To. The template argument is the element type in xsimd 12 and later, the batch type in
/// xsimd 8.
template <class To, class V>
xsimd::batch<To> bits_as(xsimd::batch<V> x) {
    if constexpr (requires {
                      { xsimd::bitwise_cast<To>(x) } -> std::same_as<xsimd::batch<To>>;
                  })
        return xsimd::bitwise_cast<To>(x);
    else
        return xsimd::bitwise_cast<xsimd::batch<To>>(x);
}

// The bit layout of the two precisions. integer_offset is 2^mantissa_bits: the sum of it and a smaller integer that is not negative has
// that integer in its lowest bits.
template <class V>
struct FloatLayout;
template <>
struct FloatLayout<double> {
    using Bits = std::uint64_t;
    static constexpr int mantissa_bits = 52, bias = 1023;
    static constexpr double integer_offset = 0x1p52;
};
template <>
struct FloatLayout<float> {
    using Bits = std::uint32_t;
    static constexpr int mantissa_bits = 23, bias = 127;
    static constexpr float integer_offset = 0x1p23F;
};

// The functions of number.hpp with the same names, for lanes.

template <class V>
Lanes<V> nearest(Lanes<V> x) {
    const Lanes<V> big(V(1.5) * FloatLayout<V>::integer_offset);
    return (x + big) - big;
}
template <class V>
Lanes<V> times_power_of_two(Lanes<V> x, Lanes<V> k) {
    using Bits = typename FloatLayout<V>::Bits;
    const auto shifted = bits_as<Bits>(k + Lanes<V>(FloatLayout<V>::integer_offset + V(FloatLayout<V>::bias)));
    return x * bits_as<V>(shifted << FloatLayout<V>::mantissa_bits);
}
template <class V>
Lanes<V> mantissa(Lanes<V> x) {
    using Bits = typename FloatLayout<V>::Bits;
    const xsimd::batch<Bits> mantissa_mask((Bits{1} << FloatLayout<V>::mantissa_bits) - 1),
        one(Bits{FloatLayout<V>::bias} << FloatLayout<V>::mantissa_bits);
    return bits_as<V>((bits_as<Bits>(x) & mantissa_mask) | one);
}
template <class V>
Lanes<V> exponent(Lanes<V> x) {
    using Bits = typename FloatLayout<V>::Bits;
    const auto offset_bits = bits_as<Bits>(Lanes<V>(FloatLayout<V>::integer_offset));
    const auto biased_exponent = (bits_as<Bits>(x) >> FloatLayout<V>::mantissa_bits) | offset_bits;  // plus integer_offset
    return bits_as<V>(biased_exponent) - Lanes<V>(FloatLayout<V>::integer_offset + V(FloatLayout<V>::bias));
}

template <>
inline constexpr double exp_limit<Lanes<float>> = 87;
template <>
inline constexpr double series_limit<Lanes<float>> = 0.3;

}  // namespace corpuscle::num
