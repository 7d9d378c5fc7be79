#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace corpuscle {

inline constexpr std::size_t large_page_size = std::size_t{1} << 21;  ///< bytes, on usual machines

/// Asks the system for huge pages in the part of this memory that is aligned to them. Each costs one page fault instead of 512. Where
/// there are none, nothing happens.
inline void request_large_pages([[maybe_unused]] const void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
    const auto begin = reinterpret_cast<std::uintptr_t>(memory), end = (begin + bytes) / large_page_size * large_page_size;
    const auto from = (begin + large_page_size - 1) / large_page_size * large_page_size;
    if (from < end) (void)::madvise(reinterpret_cast<void*>(from), end - from, MADV_HUGEPAGE);
#endif
}

/// Reserves space for `size` elements, in huge pages where possible.
template <class V>
void reserve_large(std::vector<V>& array, std::size_t size) {
    array.reserve(size);
    request_large_pages(array.data(), array.capacity() * sizeof(V));
}

}  // namespace corpuscle
