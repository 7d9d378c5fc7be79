#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <type_traits>
#include <utility>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace corpuscle::lanes {

/// A zero-initialised array of plain data, aligned to a cache line. It comes from calloc, whose pages take no memory before they are
/// written: a skin needs memory only for the tiles that are touched. Arrays of 4 MB and more are aligned to 2 MB and request huge pages,
/// because with pages of 4 kB, each such page of force costs a look-up in the page table.
template <class V>
class AlignedBuffer {
    static_assert(std::is_trivially_copyable_v<V>);
    void* allocated_ = nullptr;  // by calloc; data_ is the first aligned address in it
    V* data_ = nullptr;
    std::size_t size_ = 0;
    static constexpr std::size_t large_page = std::size_t{1} << 21;

public:
    AlignedBuffer() = default;
    explicit AlignedBuffer(std::size_t size) : size_(size) {
        const std::size_t bytes = size * sizeof(V), alignment = bytes >= 2 * large_page ? large_page : 64;
        allocated_ = std::calloc(bytes + alignment, 1);
        if (!allocated_) throw std::bad_alloc();
        const std::size_t beyond = reinterpret_cast<std::uintptr_t>(allocated_) % alignment;
        data_ = reinterpret_cast<V*>(static_cast<std::byte*>(allocated_) + (alignment - beyond) % alignment);
#ifdef __linux__
        if (alignment == large_page) (void)madvise(data_, bytes, MADV_HUGEPAGE);
#endif
    }
    AlignedBuffer(AlignedBuffer&& other) noexcept { swap(other); }
    AlignedBuffer& operator=(AlignedBuffer&& other) noexcept {
        swap(other);
        return *this;
    }
    ~AlignedBuffer() { std::free(allocated_); }

    V* data() const { return data_; }
    std::size_t size() const { return size_; }

private:
    void swap(AlignedBuffer& other) noexcept {
        std::swap(allocated_, other.allocated_), std::swap(data_, other.data_), std::swap(size_, other.size_);
    }
};

}  // namespace corpuscle::lanes
