#pragma once

namespace corpuscle::test {

/// True in builds with a sanitizer, which needs far more address space than the program itself.
#ifdef __has_feature
inline constexpr bool is_sanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool is_sanitized = true;
#else
inline constexpr bool is_sanitized = false;
#endif

}  // namespace corpuscle::test
